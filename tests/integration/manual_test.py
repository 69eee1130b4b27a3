"""The manual page and the shell completion name every command and option of the program.

usage: manual_test.py PROGRAM MANUAL.PY
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True)


def main():
    program, maker = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        run(sys.executable, maker, program, folder)
        page = pathlib.Path(folder, "depthmocap.1").read_text()
        completion = pathlib.Path(folder, "depthmocap.bash")
        listed = run(program, "--help").stdout.split("Subcommands:")[1].split("\n\n")[0]
        commands = [line.split()[0] for line in listed.strip().splitlines()]
        assert "replay" in commands and "synthesize" in commands, commands
        for command in commands:
            assert f".SH {command.upper().replace('-', chr(92) + '-')}\n" in page, f"no section of {command}"
        assert r"\-\-bvh" in page and r"\-\-motion" in page
        if shutil.which("groff"):
            said = run("groff", "-ww", "-man", "-Tutf8", f"{folder}/depthmocap.1").stderr
            assert not said, said
        words = "source {0}; COMP_WORDS=({1}); COMP_CWORD={2}; _depthmocap; echo ${{COMPREPLY[@]}}"

        def completed(*typed):
            line = words.format(completion, " ".join(typed), len(typed) - 1)
            return run("bash", "-c", line).stdout.split()
        assert completed("depthmocap", "rep") == ["replay", "repair"], completed("depthmocap", "rep")
        assert "--bvh-moving" in completed("depthmocap", "replay", "--bvh"), completed("depthmocap", "replay", "--bvh")
        assert completed("depthmocap", "synthesize", "--mot") == ["--motion"]


if __name__ == "__main__":
    main()
