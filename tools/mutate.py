#!/usr/bin/env python3
"""Plants random one-line faults, each behind a switch of its own, in a copy of the tree:

    mkdir ../faulty && git archive HEAD | tar -x -C ../faulty
    cmake -S ../faulty -B ../faulty/build -G Ninja -DIFOV_BENCHMARKS=OFF -DIFOV_JOIN_SOURCES=OFF
    tools/mutate.py ../faulty --seed 1 --count 100
    cmake --build ../faulty/build
    tools/run_mutants.py ../faulty

One build holds all of them: MUTANT=17 in the environment turns on the 17th, without it there are none. Every room
gets its share by the number of its eligible lines, and --spare more, which stand in for faults that turn out to
change nothing. What was planted goes to mutants.json in the copy; docs/developer/mutants.md has what came of it.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import random
import re
import shlex
import subprocess
import sys

ROOMS = ["sampling", "render", "radiometry", "atmosphere", "io/products"]

SWITCH = r"""// Which planted fault is on (MUTANT), and which were met (MUTANTS_MET: a file of zeros, a byte for each).
#pragma once
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

namespace mutants {
struct Switch {
  int active = 0;
  volatile unsigned char* met = nullptr;
  Switch() {
    if (const char* text = std::getenv("MUTANT")) active = std::atoi(text);
    const char* name = std::getenv("MUTANTS_MET");
    const int file = name != nullptr ? ::open(name, O_RDWR | O_CLOEXEC) : -1;
    if (file < 0) return;
    void* memory = ::mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (memory != MAP_FAILED) met = static_cast<volatile unsigned char*>(memory);
    ::close(file);
  }
};
inline const Switch state;
inline bool on(int number) {
  if (state.met != nullptr) state.met[number] = 1;
  return state.active == number;
}
}  // namespace mutants
"""
# Faults may break what only warnings hold: they are what is wanted here.
QUIET = "".join(f'#pragma GCC diagnostic ignored "-W{name}"\n' for name in """
    conversion float-conversion parentheses dangling-else unused-variable unused-parameter unused-value unused-function
    unused-but-set-variable unused-but-set-parameter maybe-uninitialized int-in-bool-context sign-compare shadow
    tautological-compare logical-op bool-operation bool-compare type-limits""".split())

# Not behaviour: words for people, sizes of memory, checks at compile time; and what a switch cannot be written into.
LEFT_OUT = re.compile(
    r"constexpr|static_assert|\bassert\(|\bthrow\b|Error\(|[Ww]arn|[Mm]essage|fmt::|format\(|<<|reserve\(|resize\(|"
    r"shrink_to_fit|__restrict|prefetch|auto&|auto \[|& \w+ = |\[[&=]?\w*\]\(|\btemplate\b|\busing\b|\btypedef\b|"
    r"\boperator\b|\bfriend\b|= (default|delete);|\bstatic\b|[\"'][^\"']* [^\"']*[\"']|\\$|^\s*#")
TOKEN = re.compile(r"""(?P<text>"(?:\\.|[^"])*"|'(?:\\.|[^'])*')|"""
                   r"""(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?[uUlLfF]*)|"""
                   r"""(?P<name>[A-Za-z_](?:\w|::(?=\w))*)|(?P<sign><=|>=|==|!=|&&|\|\||[-+*/%]=|->|\+\+|--|.)""")
SWAPS = {"+": "-", "-": "+", "*": "/", "/": "*", "<": ">", ">": "<", "<=": ">=", ">=": "<=", "==": "!=", "!=": "==",
         "&&": "||", "||": "&&", "std::min": "std::max", "std::max": "std::min", "true": "false", "false": "true"}
ENDS_TERM = ["+", "-", "<", ">", "<=", ">=", "==", "!=", "&&", "||", "?", ":", ",", ";"]


def tokens(text):
    """(kind, text, begin) of everything but spaces."""
    return [(m.lastgroup, m.group(), m.start()) for m in TOKEN.finditer(text) if not m.group().isspace()]


def term_end(parts, start, stops):
    """Where the operand that begins at parts[start] ends: before an operator of `stops`, or a closing bracket."""
    depth = 0
    for _, word, begin in parts[start:]:
        if word in "([{":
            depth += 1
        elif word in ")]}":
            depth -= 1
        if depth < 0 or depth == 0 and word in stops:
            return begin
    return parts[-1][2] + len(parts[-1][1])


def faulty(expression):
    """Every expression that differs by one fault."""
    parts = tokens(expression)
    found = []

    def put(begin, end, text):
        found.append(" ".join((expression[:begin] + text + expression[end:]).split()))

    for i, (kind, word, begin) in enumerate(parts):
        end = begin + len(word)
        binary = expression[begin - 1:begin] == " " and expression[end:end + 1] == " " and i > 0
        if kind == "number":
            number = word.rstrip("uUlLfF") if not word.startswith("0x") else word
            suffix = word[len(number):]
            whole = re.fullmatch(r"\d+", number)
            new = str(int(number) + 1) if whole else "1.0" if float(number) == 0.0 else repr(2.0 * float(number))
            put(begin, end, new + suffix)
        elif word in SWAPS and (binary or kind == "name"):
            put(begin, end, SWAPS[word])
            if word in "+-*/":
                stop = term_end(parts, i + 1, ENDS_TERM + (["*", "/", "%"] if word in "*/" else []))
                put(begin - 1, stop, " " if expression[stop - 1] == " " else "")
        elif word == "!":
            put(begin, end, "")
    return [fault for fault in found if fault.strip() != expression.strip()]


def balanced(text):
    return all(text.count(a) == text.count(b) for a, b in ("()", "[]", "{}"))


def top_level(text, sign):
    """Places of a sign outside of all brackets."""
    depth, found = 0, []
    for _, word, begin in tokens(text):
        depth += (word in "([{") - (word in ")]}")
        if depth == 0 and word == sign:
            found.append(begin)
    return found


def simple(statement):
    """(fault, planted line with @ for the number) of one complete statement without its control words."""
    body = statement[:-1]
    if top_level(body, ";"):
        return
    declared = re.match(r"(?:const )?(?:auto|[A-Za-z_][\w:]*(?:<[\w:, <>]*>)?\*?) [A-Za-z_]\w*(?: = |\{)", body)
    if body.startswith("return ") or not declared:
        if body.startswith("return "):
            changed = ["return " + fault for fault in faulty(body[7:])]
        elif assigned := re.match(r"([\w.\->\[\]()* +:]*?[\w\])]) ([-+*/]?=) (?!=)(.*)$", body):
            left, sign, right = assigned.groups()
            changed = [f"{left} {sign} {fault}" for fault in faulty(right)]
            changed += [""] + ([left + " " + {"+": "-", "-": "+", "*": "/", "/": "*"}[sign[0]] + "= " + right]
                               if sign != "=" else [])
        elif re.match(r"[a-z][\w.\->:\[\]]*\(", body) and body.endswith(")"):
            name, arguments = body.split("(", 1)
            changed = [name + "(" + fault for fault in faulty(arguments)] + [""]
        else:
            return
        for fault in changed:
            yield (fault + ";" if fault else "(dropped)",
                   f"{{ if (mutants::on(@)) {{ {fault}; }} else {{ {statement} }} }}")
    elif " = " in body:
        commas = [0] + [place + 1 for place in top_level(body, ",")] + [len(body) + 1]
        for begin, end in zip(commas, commas[1:]):
            head, sign, value = body[begin:end - 1].partition(" = ")
            if not sign or "&" in head:
                continue
            for fault in faulty(value):
                whole = body[:begin] + head + " = {}" + body[end - 1:] + ";"
                yield whole.replace("{}", fault), whole.replace("{}", f"(mutants::on(@) ? ({fault}) : ({value}))")


def faults_of(line, before):
    """(original, fault, planted) for the code of one line, or nothing where it is no complete statement."""
    code = line.split("//")[0].rstrip()
    text = code.lstrip()
    if not text or LEFT_OUT.search(code) or not re.search(r"([;{}]|:|\)|\belse)$|^$", before.split("//")[0].rstrip()):
        return
    indent, prefix = code[:len(code) - len(text)], ""
    if text.startswith("} "):
        prefix, text = "} ", text[2:]
    while control := re.match(r"(else if|else|if|while|for) ?", text):
        if control.group(1) == "else":
            prefix, text = prefix + text[:control.end()], text[control.end():]
            continue
        close = next((i for i in range(len(text)) if text[i] == ")" and balanced(text[:i + 1])), None)
        if close is None:
            return
        head, condition = text[:control.end()] + "(", text[control.end() + 1:close]
        rest = text[close + 1:]
        if control.group(1) != "for" and not top_level(condition, ";") and rest.strip() != ";":
            for fault in faulty(condition) + ([f"!({condition})"] if control.group(1) != "while" else []):
                yield (text, head + fault + ")" + rest,
                       f"{indent}{prefix}{head}mutants::on(@) ? ({fault}) : ({condition})){rest}")
        prefix, text = prefix + text[:close + 1] + " ", rest.lstrip()
    if text.endswith(";") and balanced(text):
        for fault, planted in simple(text):
            yield text, fault, indent + prefix + planted


def in_functions(lines):
    """For each line whether it begins within a function: neither a class nor a namespace is the innermost bracket."""
    inside, since, answer = [False], "", []
    for line in lines:
        answer.append(inside[-1])
        for _, word, _ in tokens("" if line.lstrip().startswith(("//", "#")) else line.split("//")[0]):
            if word == "{":
                inside.append(not re.search(r"(?:^| )(?:struct|class|enum|union|namespace|extern) (?!.*\))", since))
            elif word == "}":
                inside.pop()
            since = "" if word in "{};" else since + word + " "
    return answer


def lines_of(copy, room):
    """Every eligible line of a room: (file, number from 1, its faults)."""
    found = []
    for path in sorted((copy / "src" / room).rglob("*")):
        if path.suffix not in (".h", ".cpp"):
            continue
        before, lines = ";", path.read_text().splitlines()
        for number, (line, inside) in enumerate(zip(lines, in_functions(lines)), 1):
            if line.strip().startswith("//") or not line.strip():
                continue
            faults = list(dict.fromkeys(faults_of(line, before))) if inside else []
            if faults:
                found.append((str(path.relative_to(copy)), number, faults))
            before = line
    return found


def plant(copy, originals, mutants):
    """Writes the files that hold mutants; error messages keep the numbers of the lines."""
    for file in {m["file"] for m in mutants} - originals.keys():
        originals[file] = (copy / file).read_text()
    for file, text in originals.items():
        lines = text.splitlines()
        here = [m for m in mutants if m["file"] == file]
        for mutant in here:
            lines[mutant["line"] - 1] = mutant["planted"].replace("@", str(mutant["number"]))
        head = ['#include "mutants.h"', "#line 1"] if here else []
        planted = "\n".join(head + lines) + "\n"
        if (copy / file).read_text() != planted:
            (copy / file).write_text(planted)


def errors(copy, commands, file):
    """What the compiler says of a file: nothing where it compiles."""
    room = next(c for c in commands if c["file"].startswith(str(copy / pathlib.Path(*pathlib.Path(file).parts[:2]))))
    command = next((c for c in commands if c["file"] == str(copy / file)), room)
    words = [w for w in shlex.split(command["command"]) if not w.endswith("ccache")]
    words = words[:words.index("-o")] + ["-c", "-o", "/dev/null", "-x", "c++", "-"]
    text = f'#include "{copy / file}"\n'
    return subprocess.run(words, input=text, cwd=command["directory"], capture_output=True, text=True, timeout=300,
                          check=False).stderr


def choose(copy, seed, count, spare, jobs):
    """Mutants that compile, in the order of the seed: the share of each room and then its spares."""
    commands = json.loads((copy / "build" / "compile_commands.json").read_text())
    waiting = {room: lines_of(copy, room) for room in ROOMS}
    total = sum(map(len, waiting.values()))
    exact = {room: count * len(lines) / total for room, lines in waiting.items()}
    share = {room: int(part) for room, part in exact.items()}
    for room in sorted(ROOMS, key=lambda r: share[r] - exact[r])[:count - sum(share.values())]:
        share[room] += 1
    print(f"{total} eligible lines:", {room: (len(waiting[room]), share[room]) for room in ROOMS}, flush=True)
    for room, lines in waiting.items():
        random.Random(f"{seed} {room}").shuffle(lines)
    chosen, originals, checked = {room: [] for room in ROOMS}, {}, set()
    while True:
        for room in ROOMS:
            while len(chosen[room]) < share[room] + spare:
                file, line, faults = waiting[room].pop(0)
                original, fault, planted = random.Random(f"{seed} {file} {line}").choice(faults)
                chosen[room].append({"room": room, "file": file, "line": line, "original": original, "fault": fault,
                                     "planted": planted})
        everything = [m for room in ROOMS for m in chosen[room][:share[room]]]
        everything += [m | {"spare": True} for room in ROOMS for m in chosen[room][share[room]:]]
        for number, mutant in enumerate(everything, 1):
            mutant["number"] = number
        files = sorted({m["file"] for m in everything})
        plant(copy, originals, everything)
        due = [f for f in files if (f, frozenset(m["line"] for m in everything if m["file"] == f)) not in checked]
        if not due:
            return everything
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            said = dict(zip(due, pool.map(lambda f: errors(copy, commands, f), due)))
        for file, words in said.items():
            here = {m["line"] for m in everything if m["file"] == file}
            checked.add((file, frozenset(here)))
            named = {int(n) for n in re.findall(re.escape(pathlib.Path(file).name) + r":(\d+):", words)} & here
            for line in (named or here) if "error" in words else ():
                print(f"does not compile: {file}:{line}", flush=True)
                for room in ROOMS:
                    chosen[room] = [m for m in chosen[room] if (m["file"], m["line"]) != (file, line)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("copy", type=pathlib.Path, help="a copy of the tree, configured in its folder build")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--spare", type=int, default=5, help="further faults of each room")
    arguments = parser.parse_args()
    copy = arguments.copy.resolve()
    if (copy / ".git").exists() or (copy / "mutants.json").exists():
        sys.exit("this wants a fresh copy: it changes the sources")
    (copy / "src" / "mutants.h").write_text(SWITCH + QUIET)
    mutants = choose(copy, arguments.seed, arguments.count, arguments.spare, os.cpu_count())
    (copy / "mutants.json").write_text(json.dumps(mutants, indent=1) + "\n")


if __name__ == "__main__":
    main()
