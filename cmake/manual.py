"""Writes the manual page and the shell completion from what the program itself says of its commands and options.

usage: manual.py PROGRAM FOLDER      into FOLDER: depthmocap.1 and depthmocap.bash
"""
import pathlib
import re
import subprocess
import sys


def help_of(program, *command):
    return subprocess.run([program, *command, "--help"], capture_output=True, text=True, check=True).stdout


def commands_of(text):
    """{name: what it does} of the section of commands of a help text; empty where there is none."""
    section = re.search(r"^Subcommands:\n((?:  .*\n)+)", text, re.MULTILINE)
    lines = section.group(1).splitlines() if section else []
    found = {}
    for line in lines:
        entry = re.match(r"  (\S+)\s+(.*)", line)
        if entry:
            found[entry.group(1)] = entry.group(2)
    return found


def options_of(text):
    return sorted(set(re.findall(r"(?<![\w-])--[a-z][a-z0-9-]*", text)))


def escaped(text):
    """As roff takes it: nothing is a request, dashes stay dashes."""
    lines = text.replace("\\", "\\e").replace("-", "\\-").splitlines()
    return "\n".join("\\&" + line if line[:1] in (".", "'") else line for line in lines)


def manual(version, overview, helps):
    parts = [f'.TH DEPTHMOCAP 1 "" "depthmocap {version}" "User Commands"', ".SH NAME",
             "depthmocap \\- motion capture with one depth camera", ".SH SYNOPSIS", ".B depthmocap",
             ".I command", "[options]", ".SH DESCRIPTION", ".nf", escaped(overview.strip()), ".fi"]
    for name, text in helps.items():
        parts += [f".SH {escaped(name.upper())}", ".nf", escaped(text.strip()), ".fi"]
    return "\n".join(parts) + "\n"


def completion(names, helps):
    cases = "\n".join(f"    {name.replace(' ', chr(92) + ' ')}) words=\"{' '.join(options_of(text))}\" ;;"
                      for name, text in helps.items() if " " not in name)
    return f"""# Bash completion of depthmocap, made from its own help.
_depthmocap() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} words="{' '.join(names)}"
  if [[ $COMP_CWORD -gt 1 ]]; then
    [[ $current == -* ]] || {{ COMPREPLY=($(compgen -f -- "$current")); return; }}
    case ${{COMP_WORDS[1]}} in
{cases}
    esac
  fi
  COMPREPLY=($(compgen -W "$words" -- "$current"))
}}
complete -o filenames -F _depthmocap depthmocap
"""


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    overview = help_of(program)
    helps = {}
    for name in commands_of(overview):
        helps[name] = help_of(program, name)
        for inner in commands_of(helps[name]):
            helps[f"{name} {inner}"] = help_of(program, name, inner)
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.split()[-1]
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "depthmocap.1").write_text(manual(version, overview, helps))
    (folder / "depthmocap.bash").write_text(completion(list(commands_of(overview)), helps))


if __name__ == "__main__":
    main()
