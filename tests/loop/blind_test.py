# SPDX-License-Identifier: GPL-3.0-or-later
"""The blind trial with fixed limits: false alarms, effects with a name, forms without one. The seed may be changed
(TRUEFLANK_BLIND_SEED); the limits hold for any."""
import os
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent / "blind"))
import blind  # noqa: E402
import trial  # noqa: E402

SEED = int(os.environ.get("TRUEFLANK_BLIND_SEED", "1"))
CAMPAIGN = "TRUEFLANK_CAMPAIGN" in os.environ  # three times as many: the gate tries every effect and form once


class BlindTrial(unittest.TestCase):
    def run_cases(self, kind, count):
        folder = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"]) / "blind"
        cases = [blind.Case(kind, i, SEED, "") for i in range(count)]
        trial.run_all(cases, os.environ["TRUEFLANK_PROGRAM"], folder)
        wrong = [case.line() for case in cases if not case.right]
        print(f"seed {SEED}: {kind}: {count - len(wrong)} of {count} right")
        print("\n".join(wrong))
        for case in cases:
            self.assertIsNotNone(case.answer, case.line())
            held = [case.answer[k]["held_out_rms_um"] for k in ("before", "after")]
            if None not in held:
                self.assertLessEqual(held[1], held[0] * 1.000001, "an answer made the held-out error larger: " + case.line())
        return len(wrong)

    def test_nothing_hidden_seldom_alarms(self):
        # At 3 % six or more of 60, and three or more of 20, come once or twice in a hundred such tests.
        self.assertLessEqual(*((self.run_cases("null", 60), 5) if CAMPAIGN else (self.run_cases("null", 20), 1)))

    def test_what_has_a_name_is_named(self):
        self.assertLessEqual(*((self.run_cases("named", 33), 4) if CAMPAIGN else (self.run_cases("named", 11), 1)))

    def test_what_has_no_name_is_seen_and_not_misnamed(self):
        self.assertLessEqual(*((self.run_cases("unnamed", 39), 7) if CAMPAIGN else (self.run_cases("unnamed", 13), 2)))


if __name__ == "__main__":
    unittest.main()
