#!/usr/bin/env python3
"""Gives scripts/check-tuning pages that disagree with the code and sees each difference caught.

That docs/tuning.md itself agrees is a step of scripts/test, not of this test.
"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[3] / "scripts/check-tuning"

CODE = """\
// constexpr int kCommentedOut = 1;
constexpr double kTilt_rad = 30.0 * std::numbers::pi / 180.0;
inline constexpr float kReach_m = 0.5F;  // from here
constexpr int kVersion = 1;
struct Config {
  double weight = 2.0;
  std::array<double, 2> scale{1.0,
                              3.0};
};
"""
PAGE = """\
### `stage.cpp`

Not tuned: `kVersion`.

| name | value | unit | how chosen |
|---|---|---|---|
| `kTilt_rad` | 30 * pi / 180 | rad | by hand |
| `kReach_m` | 0.50 | m | by hand |
| `weight` | 2 |  | by hand |
| `scale` | 1, 3 |  | by hand |
"""


class CheckTuning(unittest.TestCase):
    def check(self, page, code=CODE):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "docs").mkdir()
            (Path(folder) / "docs/tuning.md").write_text(page)
            (Path(folder) / "stage.cpp").write_text(code)
            return subprocess.run([sys.executable, SCRIPT, folder], capture_output=True, text=True, check=False)

    def assert_caught(self, message, page=PAGE, code=CODE):
        result = self.check(page, code)
        self.assertEqual(result.returncode, 1, f"went unseen: {message}")
        self.assertEqual(result.stdout, f"docs/tuning.md: {message}\n")

    def test_a_page_that_agrees_passes(self):
        result = self.check(PAGE)
        self.assertEqual((result.returncode, result.stdout), (0, ""))

    def test_another_value(self):
        self.assert_caught("kReach_m is 0.6F in stage.cpp, not 0.50", code=CODE.replace("0.5F", "0.6F"))
        self.assert_caught("weight is 2.0 in stage.cpp, not 3", page=PAGE.replace("| 2 |", "| 3 |"))
        self.assert_caught("scale is {1.0, 3.0} in stage.cpp, not 1, 4", page=PAGE.replace("1, 3", "1, 4"))

    def test_a_constant_without_a_row(self):
        self.assert_caught("kNew of stage.cpp has no row", code=CODE + "constexpr std::size_t kNew = 3;\n")

    def test_a_row_without_a_constant(self):
        self.assert_caught("stage.cpp has no kCommentedOut", page=PAGE + "| `kCommentedOut` | 1 |  | by hand |\n")

    def test_a_file_that_is_gone(self):
        self.assert_caught("there is no gone.cpp", page=PAGE + "\n### `gone.cpp`\n")


if __name__ == "__main__":
    unittest.main()
