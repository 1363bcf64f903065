"""The rules of docs/developer/architecture.md, read from that page and applied to a source tree."""

import dataclasses
import pathlib
import re

INCLUDE = re.compile(r'^[ \t]*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
# Printing and leaving, but not snprintf, fprintf into a named file, or members such as file.exit(...).
PRINTS = re.compile(
    r"(?<![\w.>])(?:std::)?(?:v?printf|puts|putchar|perror)\s*\("
    r"|\bstd::(?:cout|cerr|clog|print|println)\b|\bfmt::print(?:ln)?\b|\b(?:stdout|stderr)\b"
)
EXITS = re.compile(r"(?<![\w.>:])(?:std::)?(?:exit|_exit|_Exit|quick_exit|abort|terminate)\s*\(")
SPEAKERS = ("cli",)  # the room that owns the terminal


@dataclasses.dataclass
class Rules:
    levels: dict  # room -> level
    adapters: dict  # first part of an outside header's path -> rooms that may include it
    public: dict  # header of include/ -> rooms that may include it
    parts: dict = dataclasses.field(default_factory=dict)  # library of a part of a room -> folders, libraries, outside libraries


@dataclasses.dataclass
class Library:
    """What a CMakeLists.txt says of a library: a room, or a part of one, which has folders of it."""

    room: str
    part: str  # empty: the room is one library
    folders: list
    parts: list
    rooms: list
    outside: list

    @property
    def name(self):
        return f"{self.room}_{self.part}" if self.part else self.room


def table_rows(page, first_heading):
    """Rows of the Markdown table whose first heading is `first_heading`, as lists of cells."""
    rows, inside = [], False
    for line in page.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")] if line.startswith("|") else None
        if cells is None:
            inside = False
        elif cells[0] == first_heading:
            inside = True
        elif inside and not set(cells[0]) <= set("-: "):
            rows.append(cells)
    return rows


def read_rules(page):
    names = lambda cell: re.findall(r"`([^`]+)`", cell)
    levels = {names(row[1])[0]: int(row[0]) for row in table_rows(page, "level")}
    adapters = {header: names(row[2]) for row in table_rows(page, "headers") for header in names(row[0])}
    public = {header: names(row[1]) for row in table_rows(page, "public header") for header in names(row[0])}
    parts = {f"{names(row[0])[0]}_{name}": tuple(names(cell) for cell in row[2:5]) for row in table_rows(page, "room in parts") for name in names(row[1])}
    return Rules(levels, adapters, public, parts)


def without_comments_and_strings(text):
    """Comments removed and string contents emptied; line breaks stay, so that line numbers hold."""
    pattern = re.compile(
        r'//[^\n]*|/\*.*?\*/|R"([^(\s]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', re.DOTALL
    )

    def blank(match):
        text = match.group(0)
        return ('""' if text[0] in "\"R" else "") + "\n" * text.count("\n")

    return pattern.sub(blank, text)


def adapter_of(header, adapters):
    """The row of the outside-library table that a header falls under: embree3/rtcore.h under `embree`."""
    first = header.split("/")[0]
    stem = first.removesuffix(".hpp").removesuffix(".h")
    for prefix in adapters:
        if stem == prefix or re.fullmatch(re.escape(prefix) + r"\d+", stem) or (
            prefix.endswith("_") and stem.startswith(prefix)
        ):
            return prefix
    return None


def libraries_of(folder):
    """The libraries that a room's CMakeLists.txt declares; of a program the rooms that it sets as IFOV_<ROOM>_ROOMS."""
    file = folder / "CMakeLists.txt"
    text = re.sub(r"#[^\n]*", "", file.read_text()) if file.exists() else ""
    found = [Library(folder.name, "", [], [], rooms.split(), [])
             for rooms in re.findall(rf"\bset\(IFOV_{folder.name.upper()}_ROOMS ([^)]*)\)", text)]
    for kind, body in re.findall(r"\bifov_(room|part)\(([^)]*)\)", text):
        words, lists, key = [], {}, None
        for word in body.split():
            if word in ("FOLDERS", "PARTS", "ROOMS", "LIBRARIES"):
                key = word
            elif key:
                lists.setdefault(key, []).append(word)
            else:
                words.append(word)
        get = lambda key: lists.get(key, [])
        found.append(Library(words[0], words[1] if kind == "part" else "", get("FOLDERS"), get("PARTS"), get("ROOMS"), get("LIBRARIES")))
    return found


def folder_in_room(path):
    """The folder of a room that a path within it is in; "." for the room's own files."""
    parts = pathlib.PurePath(path).parts
    return parts[0] if len(parts) > 1 else "."


def library_of(file, room, libraries):
    """The library that a file of a room is in; None where nothing is declared, or none of the parts has its folder."""
    folder = folder_in_room(file.relative_to(room))
    return next((library for library in libraries if not library.part or folder in library.folders), None)


def part_violations(source, rules):
    """Folders that no part of their room has, or several; and where a CMakeLists.txt and the table of parts differ."""
    found, declared = [], {}
    for room in sorted(path for path in source.iterdir() if path.is_dir()):
        parts = [library for library in libraries_of(room) if library.part]
        declared.update({library.name: (library.folders, library.parts, library.outside) for library in parts})
        own = ["."] if any(path.suffix in SOURCES for path in room.iterdir()) else []
        for folder in sorted(own + [path.name for path in room.iterdir() if path.is_dir()] if parts else []):
            owners = [library.name for library in parts if folder in library.folders]
            if len(owners) != 1:
                found.append(f"{room.name}/{folder}: in {' and '.join(owners) or 'no part'}")
    for name in sorted(set(declared) | set(rules.parts)):
        of_table, of_build = rules.parts.get(name), declared.get(name)
        if of_table is None or of_build is None:
            found.append(f"{name}: not in {'the table' if of_table is None else 'a CMakeLists.txt'}")
        else:
            for what, here, there in zip(("folders", "parts", "outside libraries"), of_table, of_build):
                if set(here) != set(there):
                    found.append(f"{name}: {what} are {', '.join(here)} in the table, {', '.join(there)} in CMakeLists.txt")
    return found


def violations(source, rules):
    """Everything under `source` (a src/ folder) that breaks the rules, as 'file:line: what'."""
    found = []
    for folder in sorted(path for path in source.iterdir() if path.is_dir()):
        room = folder.name
        if room not in rules.levels:
            if any(folder.rglob("*.[ch]*")):
                found.append(f"{room}/: not a room of the table")
            continue
        libraries = libraries_of(folder)
        for file in sorted(folder.rglob("*")):
            if file.suffix in SOURCES:
                found += file_violations(file, source, room, library_of(file, folder, libraries), rules)
    return found


NO_CODE = "*no code yet:*"


def emptiness_faults(page, source):
    """Rooms that the page says are empty and are not, or the other way round."""
    found = []
    for row in table_rows(page, "level"):
        room = re.findall(r"`([^`]+)`", row[1])[0]
        has_code = any(file.suffix in SOURCES for file in (source / room).rglob("*")) if (source / room).is_dir() else False
        if has_code == (NO_CODE in row[2]):
            found.append(f"{room}: {'has code' if has_code else 'has no code'}, and the page says otherwise")
    return found


def folder_table_faults(page, source):
    """Folders of rooms that the page's table of folders does not name, and names of folders that there are not."""
    named = {re.findall(r"`([^`]+)`", row[0])[0]: re.findall(r"`([a-z_/]+)`", row[1]) for row in table_rows(page, "room")}
    found = []
    for room in sorted(path for path in source.iterdir() if path.is_dir()):
        folders = {str(path.relative_to(room)) for path in room.rglob("*")
                   if path.is_dir() and any(file.suffix in SOURCES for file in path.iterdir())}
        names = named.pop(room.name, [])
        is_named = lambda folder, names=names: any(folder == name or folder.endswith("/" + name) for name in names)
        found += [f"{room.name}/{folder} is not in the table" for folder in sorted(folders) if not is_named(folder)]
        found += [f"{room.name} has no folder '{name}'" for name in names
                  if not any(folder == name or folder.endswith("/" + name) for folder in folders)]
    return found + [f"{room} is no room of src" for room in named]


SOURCES = (".h", ".hpp", ".cpp", ".cc", ".inl")
MOST_FILES = 40


def crowded_folders(source):
    """Folders with more files than a person looks through, as 'folder: count files'."""
    folders = sorted(path for path in source.rglob("*") if path.is_dir())
    counts = {folder: sum(1 for file in folder.iterdir() if file.is_file()) for folder in folders}
    return [f"{folder.relative_to(source)}: {count} files" for folder, count in counts.items() if count > MOST_FILES]


def folder_circles(source):
    """Sets of folders whose files include each other in a circle, each as 'a, b, c'; a room's own files are a folder of
    their own beside its sub-folders."""
    reaches = {}
    for file in source.rglob("*"):
        if file.suffix in SOURCES:
            own = str(file.parent.relative_to(source))
            targets = {header.rpartition("/")[0] for quote, header in INCLUDE.findall(file.read_text()) if quote == '"'}
            reaches.setdefault(own, set()).update(targets - {own})
    for over in list(reaches):  # all that is reached, folder by folder (Warshall)
        for reached in reaches.values():
            if over in reached:
                reached |= reaches[over]
    circles = {frozenset(b for b in reached if a in reaches.get(b, ())) for a, reached in reaches.items()}
    return sorted(", ".join(sorted(circle)) for circle in circles if len(circle) > 1)


WHOLE_DOCUMENT = re.compile(r'"io/document/document\.h"|\bstruct Document;|\bio::Document\b')


def whole_documents(folder):
    """Where files of a folder know the whole document, as 'file:line'."""
    found = []
    for file in sorted(path for path in folder.rglob("*") if path.suffix in SOURCES):
        for number, line in enumerate(file.read_text().splitlines(), 1):
            if WHOLE_DOCUMENT.search(line.split("//")[0]):
                found.append(f"{file.relative_to(folder)}:{number}")
    return found


def file_violations(file, source, room, library, rules):
    found = []
    text = file.read_text()
    name = file.relative_to(source)
    own_parts = [other for other in libraries_of(source / room) if other.part]

    def declares(header):
        """Whether the library may include a header of src/: of its own, a room, or a part of one."""
        target, _, within = header.partition("/")
        folder = folder_in_room(within)
        if target == room:
            part = next((other.part for other in own_parts if folder in other.folders), library.part)
            return part == library.part or part in library.parts
        others = [other for other in libraries_of(source / target) if other.part]
        return target in library.rooms or any(folder in other.folders and other.name in library.rooms for other in others)

    def add(offset, what):
        found.append(f"{name}:{text.count(chr(10), 0, offset) + 1}: {what}")

    for match in INCLUDE.finditer(text):
        quote, header = match.groups()
        target = header.split("/")[0]
        if header.split("/")[0] == "ifov":
            if room not in rules.public.get(header, []):
                add(match.start(), f"{header} is included by {', '.join(rules.public.get(header, ['no room']))} only")
        elif quote == '"':
            if "/" not in header or target not in rules.levels:
                add(match.start(), f'"{header}" does not start at src/ with a room of the table')
            elif target != room and rules.levels[target] >= rules.levels[room]:
                add(match.start(), f"{room} (level {rules.levels[room]}) includes {target} (level {rules.levels[target]})")
            elif library is not None and not declares(header):
                what = "/".join(header.split("/")[:2]) if target == room or any(lib.part for lib in libraries_of(source / target)) else target
                add(match.start(), f"{library.name} includes {what} without declaring it in {room}/CMakeLists.txt")
        else:
            prefix = adapter_of(header, rules.adapters)
            owners = rules.adapters[prefix] if prefix else []
            if prefix and room not in owners and (library is None or library.name not in owners):
                add(match.start(), f"<{header}> belongs in {', '.join(rules.adapters[prefix])} only")
    if room not in SPEAKERS:
        code = without_comments_and_strings(text)
        for pattern, what in ((PRINTS, "a library prints"), (EXITS, "a library exits")):
            for match in pattern.finditer(code):
                line = code.count("\n", 0, match.start()) + 1
                found.append(f"{name}:{line}: {what}: {match.group(0).strip()}")
    return found


def public_violations(include):
    """Includes of the headers under include/ifov that are neither of the standard library nor among themselves."""
    found = []
    for file in sorted((include / "ifov").rglob("*.h")):
        text = file.read_text()
        for match in INCLUDE.finditer(text):
            quote, header = match.groups()
            among_themselves = quote == '"' and (include / header).exists() and header.startswith("ifov/")
            standard = quote == "<" and re.fullmatch(r"[a-z_]+", header)
            if not among_themselves and not standard:
                line = text.count("\n", 0, match.start()) + 1
                found.append(f"{file.relative_to(include)}:{line}: a public header includes {header}")
    return found
