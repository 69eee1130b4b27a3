#!/usr/bin/env python3
"""Tests the add-on in a real Blender without a screen, beside a real server.

Usage: tests/blender/run.py [--program build/depthmocap] [--blender blender] [TEST.py...]

Builds the zip, installs it into a Blender of its own settings, starts `depthmocap serve`, and runs tests/blender/*_test.py.
Exit code 77, a skipped test, where Blender is missing. --blender may be a Python that has the module bpy: Blender of PyPI.
"""
import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SKIPPED = 77


def serve(program):
    """The server's process and address."""
    process = subprocess.Popen([program, "serve", "--port", "0"], stderr=subprocess.PIPE, text=True)
    words = process.stderr.readline().split()
    if words[:1] != ["serving"]:
        sys.exit(f"run.py: the server did not start: {' '.join(words)}")
    return process, words[1].rstrip("/")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=Path, default=ROOT / "build/depthmocap")
    parser.add_argument("--blender", default="blender")
    parser.add_argument("tests", nargs="*", type=Path, default=sorted(Path(__file__).parent.glob("*_test.py")))
    options = parser.parse_args()
    blender = shutil.which(options.blender)
    if blender is None:
        print("skipped: Blender is not installed (apt install blender)")
        return SKIPPED
    is_python = "python" in Path(blender).name
    with tempfile.TemporaryDirectory() as folder:
        archive = Path(folder) / "addon.zip"
        subprocess.run([ROOT / "scripts/build-blender-addon", archive], check=True, stdout=subprocess.DEVNULL)
        addons = Path(folder) / "scripts" / "addons"
        with zipfile.ZipFile(archive) as zipped:
            zipped.extractall(addons)
        server, address = serve(options.program)
        # Debian's Blender looks for its Python's libraries beside the first python3 on the path: let that be the system's.
        path = os.environ["PATH"] if is_python else "/usr/bin:/bin"
        environment = {**os.environ, "PATH": path, "BLENDER_USER_SCRIPTS": str(addons.parent), "DEPTHMOCAP_SERVER": address,
                       "DEPTHMOCAP_PROGRAM": str(options.program.resolve()), "PYTHONPATH": os.pathsep.join([str(Path(__file__).parent), str(addons)])}
        failed = []
        try:
            for test in options.tests:
                command = [blender, test] if is_python else [blender, "--background", "--factory-startup", "--python-use-system-env",
                                                             "--python-exit-code", "1", "--python", test]
                if subprocess.run(command, env=environment).returncode != 0:
                    failed.append(test.name)
        finally:
            server.terminate()
            server.wait()
    if failed:
        print(f"run.py: failed: {' '.join(failed)}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
