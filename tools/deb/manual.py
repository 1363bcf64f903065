"""Manual pages and completion, out of what `ifov --help` and `ifov COMMAND --help` say."""

import re
import subprocess

HEADINGS = {"Positionals": "ARGUMENTS", "Subcommands": "COMMANDS"}


def help_of(program, *command):
    return subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True).stdout


def commands(program):
    """{name: what it does}, in the order of `ifov --help`."""
    listed = re.search(r"^Subcommands:\n((?:  .*\n)+)", help_of(program), re.MULTILINE).group(1)
    return dict(re.findall(r"^  (\S+) +(.*)$", listed, re.MULTILINE))


def options(text):
    """[(names, argument and rules, meaning)] of the part Options of a help text."""
    part = re.search(r"^Options:\n((?:  .*\n)+)", text, re.MULTILINE)
    found = []
    for line in part.group(1).splitlines() if part else []:
        if begun := re.match(r"  (-\S+)(.*)$", line):
            # What an option means stands in a column of its own, in this line or in the next.
            rules, _, meaning = begun.group(2).partition("  ")
            found.append([begun.group(1).split(","), rules.strip(), meaning.strip()])
        else:
            found[-1][2] = f"{found[-1][2]} {line.strip()}".strip()
    return [tuple(one) for one in found]


def roff(text):
    """Text as it is: backslashes and hyphens are no commands, and no line begins with one."""
    escaped = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join("\\&" + line if line[:1] in (".", "'") else line for line in escaped.split("\n"))


def page(program, version, date, command=None):
    """The manual page of the program, or of one of its commands."""
    text = help_of(program, *([command] if command else []))
    about, _, rest = text.partition("\n")
    name = f"ifov-{command}" if command else "ifov"
    lines = [f'.TH {name.upper()} 1 "{date}" "ifov {version}" "User Commands"']
    lines += [".SH NAME", f"{roff(name)} \\- {roff(about.rstrip('.').lower() if not command else about)}"]
    usage, _, rest = rest.partition("\n")
    lines += [".SH SYNOPSIS", f".B {roff(usage.removeprefix('Usage: '))}"]
    for part in re.split(r"\n\s*\n", rest.strip("\n")):
        first, _, under = part.partition("\n")
        if first == "Options:":
            lines.append(".SH OPTIONS")
            for names, rules, meaning in options(text):
                lines += [".TP", f"\\fB{roff(', '.join(names))}\\fR {roff(rules)}".rstrip(), roff(meaning)]
        elif first.startswith("  "):  # examples of what was said before
            lines += [".PP", ".nf", roff(part), ".fi"]
        elif first.endswith(":") and under.startswith("  "):
            title = first.rstrip(":")
            lines += [f".SH {HEADINGS.get(title, roff(title.upper()))}", ".nf", roff(under), ".fi"]
        else:
            heading = ".SH EXIT STATUS" if first.startswith("Exit codes") else ".SH DESCRIPTION"
            lines += [heading if heading not in lines else ".PP", roff(part)]
    others = ["ifov(1)"] if command else [f"ifov\\-{one}(1)" for one in commands(program)]
    lines += [".SH SEE ALSO", ",\n".join(others), ".PP", "The guide: /usr/share/doc/ifov/guide"]
    return "\n".join(lines) + "\n"


def completion(program):
    """For bash: commands, their options, and files."""
    words = {name: sorted(long for names, _, _ in options(help_of(program, name)) for long in names if long.startswith("--"))
             for name in commands(program)}
    cases = "\n".join(f"    {name}) words='{' '.join(found)}' ;;" for name, found in words.items())
    return f"""# Completion of ifov for bash.
_ifov() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} words=
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W '{" ".join(words)} --help --version' -- "$word")
    return
  fi
  case ${{COMP_WORDS[1]}} in
{cases}
  esac
  case $word in
    -*) mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word") ;;
    *) compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -f -- "$word") ;;
  esac
}}
complete -F _ifov ifov
"""
