#!/usr/bin/env python3
"""Plants violations of the architecture in a copy of the sources and sees scripts/check-arrows catch each.

That the sources themselves are clean is a step of scripts/test, not of this test.
"""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
SCRIPT = ROOT / "scripts/check-arrows"


class CheckArrows(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)
        for top in ("apps", "calibration", "forest", "libtracker"):
            shutil.copytree(ROOT / top, self.root / top,
                            ignore=lambda _, names: [name for name in names if name.endswith((".bin", ".gz", ".dat"))])

    def tearDown(self):
        self.folder.cleanup()

    def check(self):
        return subprocess.run([sys.executable, SCRIPT, self.root], capture_output=True, text=True, check=False)

    def assert_caught(self, file, include, reason):
        planted = self.root / file
        planted.write_text(f'#include "{include}"\n')
        result = self.check()
        planted.unlink()
        self.assertEqual(result.returncode, 1, f"{file} including {include} went unseen")
        self.assertIn(f'{file}: includes "{include}"', result.stdout)
        self.assertIn(reason, result.stdout)

    def test_public_headers_include_public_headers_only(self):
        self.assert_caught("libtracker/include/depthmocap/planted.h", "libtracker/core/csv.h", "public headers")

    def test_core_includes_nothing(self):
        self.assert_caught("libtracker/core/planted.h", "libtracker/skeleton/skeleton.h", "lowest")

    def test_skeleton_includes_core_only(self):
        self.assert_caught("libtracker/skeleton/planted.h", "libtracker/recording/recording.h", "lowest")

    def test_stages_do_not_know_each_other(self):
        self.assert_caught("libtracker/solve/planted.cpp", "libtracker/markers/find_markers.h", "stages")

    def test_only_the_tracker_knows_the_stages(self):
        self.assert_caught("libtracker/recording/planted.cpp", "libtracker/segment/segment.h", "only the tracker")

    def test_the_run_time_tracker_does_not_reach_offline_code(self):
        for layer in ("motion", "posedb_build", "body", "evaluation"):
            self.assert_caught("libtracker/tracker/planted.cpp", f"libtracker/{layer}/planted.h", "offline")

    def test_arrows_run_down_only(self):
        self.assert_caught("libtracker/body/planted.cpp", "forest/render/planted.h", "arrows run")
        self.assert_caught("forest/train/planted.cpp", "calibration/planted.h", "arrows run")
        self.assert_caught("calibration/planted.cpp", "apps/commands.h", "arrows run")

    def test_layers_include_only_what_they_link(self):
        self.assert_caught("libtracker/motion/planted.cpp", "libtracker/posedb/pose_database.h", "does not link")

    def test_includes_start_at_the_root(self):
        self.assert_caught("libtracker/core/planted.cpp", "parallel.h", "root of the repository")


if __name__ == "__main__":
    unittest.main()
