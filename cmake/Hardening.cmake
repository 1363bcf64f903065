# Makes mistakes with memory end the program instead of running what somebody put into a file:
#   canaries on the stack, bounds checks of the C library, targets of indirect jumps marked (Intel CET), addresses that differ
#   from run to run (PIE), tables of the linker that cannot be written after the start, no stack that can be executed.
# tests/cli/test_hardening.py looks at the program that was built.
option(IFOV_HARDEN "Build with the compiler's and linker's guards against damaged files" ON)

function(ifov_harden target)
  if(NOT IFOV_HARDEN)
    return()
  endif()
  target_compile_options(${target} PRIVATE -fstack-protector-strong -fcf-protection=full)
  if(NOT IFOV_SANITIZE)  # sanitizers have checks of their own, which these would hide; without optimization there are none
    target_compile_options(${target} PRIVATE $<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE> $<$<NOT:$<CONFIG:Debug>>:-D_FORTIFY_SOURCE=3>)
  endif()
  get_target_property(type ${target} TYPE)
  if(type STREQUAL "EXECUTABLE")
    target_compile_options(${target} PRIVATE -fPIE)
    target_link_options(${target} PRIVATE -pie)
  endif()
  target_link_options(${target} PRIVATE -Wl,-z,relro -Wl,-z,now -Wl,-z,noexecstack)
endfunction()
