"""What Debian's policy asks of a package beside its contents: copyright, changelog, names of libraries, overrides of lintian."""

import email.utils
import os
import textwrap

#: What is so on purpose: one package holds program, library, headers and Python package of one machine, made by whoever uses it. Tag of
#: lintian's and why.
ON_PURPOSE = {
    "package-name-doesnt-match-sonames": "program, library and headers come in one package, which is called as the program",
    "link-to-shared-library-in-wrong-package": "the headers are in the same package, and what links with them takes this name",
    "pkg-config-unavailable-for-cross-compilation": "the package is for the machine that it was made for",
}


def maintainer():
    """Whoever makes the package, as Debian's tools know them: DEBFULLNAME and DEBEMAIL."""
    return f"{os.environ.get('DEBFULLNAME', 'The ifov authors')} <{os.environ.get('DEBEMAIL', 'ifov@localhost')}>"


def copyright_file(notice):
    """Of the Apache licence Debian has the text (policy 12.5); `notice` lists what others gave."""
    described = "\n".join(" " + (line or ".") for line in notice.strip().splitlines())
    return f"""Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: ifov
Comment:
{described}

Files: *
Copyright: The ifov authors
License: Apache-2.0

License: Apache-2.0
 Licensed under the Apache License, Version 2.0; you may not use these files except in compliance with the License. They are
 distributed on an "AS IS" BASIS, WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 .
 On Debian systems the text of the license is in /usr/share/common-licenses/Apache-2.0.
"""


def changelog(version, seconds):
    """One entry in Debian's form, which names the changes' own file."""
    return (f"ifov ({version}) unstable; urgency=medium\n\n  * All changes are in CHANGELOG.md.gz beside this file.\n\n"
            f" -- {maintainer()}  {email.utils.formatdate(seconds)}\n")


def shared_libraries(version):
    """By which packages that are linked with libifov find out that they need this one."""
    major, minor = version.split(".")[:2]
    return f"libifov {major}.{minor} ifov (>= {version})\n"


def python_scripts():
    """By name: what compiles the Python package once it is there, so that not every user's import does, and takes that away (Python policy)."""
    return {
        "postinst": "#!/bin/sh\nset -e\nif command -v py3compile > /dev/null; then py3compile -p ifov; fi\n",
        "prerm": "#!/bin/sh\nset -e\nif command -v py3clean > /dev/null; then py3clean -p ifov; fi\n",
    }


def overrides():
    return "".join(f"# {textwrap.fill(why, 100, subsequent_indent='# ')}\nifov: {tag} *\n" for tag, why in ON_PURPOSE.items())
