"""Checks of the scripts beside it: python3 benches/test_scripts.py. No time is taken and nothing is built."""

import contextlib
import io
import json
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "robots"))

import accuracy
import compare
import digits
import instructions
import stages
import waits

PRINTED = """
Timer precision: 41 ns
stages                     fastest       │ slowest       │ median        │ mean          │ samples │ iters
├─ rank                                  │               │               │               │         │
│  ├─ at_pose                            │               │               │               │         │
│  │  ├─ bennett           5.9 µs        │ 12 µs         │ 6.1 µs        │ 6.4 µs        │ 100     │ 100
│  │  ╰─ scissor 100       1.234 ms      │ 2 ms          │ 1.3 ms        │ 1.3 ms        │ 100     │ 100
│  ╰─ one_loop             812 ns        │ 2 µs          │ 900.5 ns      │ 1 µs          │ 100     │ 100
╰─ parse                                 │               │               │               │         │
   ╰─ read                               │               │               │               │         │
      ╰─ bennett           1.2 s         │ 2 s           │ 1.5 s         │ 1.5 s         │ 10      │ 10
                           12.3 MB/s     │ 11 MB/s       │ 12 MB/s       │ 12 MB/s       │         │
"""


class Accuracy(unittest.TestCase):
    def test_every_step_runs_something_that_is_there(self):
        programs = [command for _, command, _ in accuracy.steps("2026-01-31", "a machine", quick=False)]
        self.assertEqual(len(programs), 3)
        self.assertEqual(len(accuracy.steps("2026-01-31", "a machine", quick=True)), 2)
        for command in programs:
            if "--example" in command:
                there = accuracy.ROOT / "examples" / command[command.index("--example") + 1] / "main.rs"
            elif "--test" in command:
                suite = command[command.index("it") + 1].removesuffix("::")
                there = accuracy.ROOT / "tests" / suite / "main.rs"
            else:
                there = accuracy.ROOT / command[1]
            self.assertTrue(there.is_file(), there)


class Stages(unittest.TestCase):
    def test_the_printed_tree_becomes_a_record(self):
        found = stages.parsed(PRINTED.splitlines())
        self.assertEqual(found["rank"]["at_pose"]["bennett"], {"fastest": 5.9e-6, "median": 6.1e-6})
        self.assertEqual(found["rank"]["at_pose"]["scissor 100"], {"fastest": 1.234e-3, "median": 1.3e-3})
        self.assertEqual(found["rank"]["one_loop"], {"fastest": 8.12e-7, "median": 9.005e-7})
        self.assertEqual(found["parse"], {"read": {"bennett": {"fastest": 1.2, "median": 1.5}}})

    def test_other_text_is_no_record(self):
        self.assertEqual(stages.parsed(["error: no such bench", "", "│ │"]), {})


class Digits(unittest.TestCase):
    FILE = '<origin xyz="0.1234567 ${third/2} 0" rpy="1.5707963267948966 0 0"/><limit lower="0.1234567"/>'

    def test_places_are_rewritten_and_nothing_else(self):
        text = '<xacro:property name="third" value="1/3"/>' + self.FILE
        self.assertIn('xyz="0.123457 0.166667 0" rpy="1.5708 0 0"', digits.rewritten(text, "6 digits"))
        self.assertIn('<limit lower="0.1234567"/>', digits.rewritten(text, "6 digits"))
        self.assertIn('rpy="1.5707963267948966 0 0"', digits.rewritten(text, "7 decimals, hidden"))

    def test_confident_answers_that_differ_are_different(self):
        def answered(verdict, finite, nominal=False, roles=()):
            return (verdict, finite, finite, None, nominal, roles)

        mobile, rigid = answered("mobile", 1, roles=(False, None)), answered("rigid", 0)
        self.assertEqual(digits.compare(mobile, answered("mobile", 1, roles=(None, True))), "same")
        self.assertEqual(digits.compare(mobile, answered("mobile", 1, roles=(True, None))), "different")
        self.assertEqual(digits.compare(mobile, rigid), "different")
        self.assertEqual(digits.compare(mobile, answered("rigid", 0, nominal=True)), "open")
        self.assertEqual(digits.compare(mobile, answered("unassembled", None)), "unassembled")
        self.assertEqual(digits.compare(mobile, ("refused", "why")), "refused")


class Compare(unittest.TestCase):
    def test_the_largest_change_comes_first(self):
        old = {"date": "1", "rank": {"a": 100, "b": 100, "c": 100, "gone": 1}}
        new = {"date": "2", "rank": {"a": 101, "b": 50, "c": 130, "added": 1}}
        rows, gone, added = compare.compared(old, new)
        self.assertEqual([row[0] for row in rows], ["rank / b", "rank / c", "rank / a"])
        self.assertEqual([row[3] for row in rows], [0.5, 1.3, 1.01])
        self.assertEqual((gone, added), (["rank / gone"], ["rank / added"]))
        self.assertEqual([row[0] for row in compare.compared(old, new, "c")[0]], ["rank / c"])

    def test_rows_of_a_list_are_known_by_their_words(self):
        rows = [{"name": "x", "n": n, "time": t} for n, t in ((1, 0.5), (2, 0.25))]
        found = compare.numbers({"rows": rows})
        self.assertEqual(found["rows / x, n 2 / time"], 0.25)
        backwards = compare.numbers({"rows": rows[::-1]})
        self.assertEqual(found, backwards)
        self.assertEqual(compare.numbers([3, [4]]), {"0": 3.0, "1 / 0": 4.0})

    def test_nothing_is_divided_by_zero(self):
        rows, _, _ = compare.compared({"a": 0, "b": 0, "c": 1}, {"a": 1, "b": 0, "c": 1})
        self.assertEqual([(row[0], row[3]) for row in rows], [("a", float("inf")), ("b", 1.0), ("c", 1.0)])
        self.assertIn("inf", compare.printed(rows, [], []))

    def test_only_a_bound_that_is_asked_for_fails(self):
        with tempfile.TemporaryDirectory() as folder:
            paths = [str(Path(folder) / name) for name in ("old.json", "new.json", "empty.json")]
            for path, record in zip(paths, ({"a": 1.0}, {"a": 1.1}, {})):
                Path(path).write_text(json.dumps(record), encoding="utf-8")
            old, new, empty = paths
            with contextlib.redirect_stdout(io.StringIO()):
                self.assertEqual(compare.main([old, new]), 0)
                self.assertEqual(compare.main([old, new, "--fail-above", "1.2"]), 0)
                self.assertEqual(compare.main([old, new, "--fail-above", "1.05"]), 1)
                self.assertEqual(compare.main([old, empty, "--fail-above", "1.05"]), 2)

    def test_every_record_can_be_compared_with_itself(self):
        for path in sorted((instructions.ROOT / "benches" / "record").glob("*.json")):
            record = json.loads(path.read_text(encoding="utf-8"))
            rows, gone, added = compare.compared(record, record)
            if path.stem == "stability_mutations":  # words only
                self.assertEqual((rows, gone, added), ([], [], []))
                continue
            self.assertTrue(rows, path.name)
            self.assertEqual((gone, added, {row[3] for row in rows}), ([], [], {1.0}), path.name)


class Waits(unittest.TestCase):
    def test_every_case_is_there(self):
        for file in (*waits.EXACT.values(), *waits.VERDICTS.values()):
            self.assertTrue((waits.ROOT / file).is_file(), file)

    def test_what_ends_by_itself_and_what_is_stopped_are_told_apart(self):
        seconds, answer, stopped = waits.once([sys.executable, "-c", "print('basis'); print('dimension 1'); print()"], 60)
        self.assertEqual((answer, stopped), ("dimension 1", False))
        self.assertGreater(seconds, 0)
        _, _, stopped = waits.once([sys.executable, "-c", "while True: pass"], 1)
        self.assertTrue(stopped)
        row = waits.summary([(0.5, "a", False), (0.25, "a", False), (1.0, "a", True)])
        self.assertEqual((row["median"], row["least"], row["greatest"], row["stopped"]), (0.5, 0.25, 1.0, True))

    def test_of_a_report_the_verdict_is_kept(self):
        report = json.dumps({"mobility": {"verdict": "mobile", "bounds": [1, 1]}})
        self.assertEqual(waits.answer_of([report], report), "mobile, 1 to 1")
        self.assertEqual(waits.answer_of(["two", "lines"], "lines"), "lines")

    def test_programs_have_names_of_their_own(self):
        self.assertEqual(waits.named(["before=/a", "now=/b"]), {"before": "/a", "now": "/b"})
        self.assertEqual(waits.named(["/a"]), {"kutzbach": "/a"})
        with self.assertRaises(SystemExit):
            waits.named(["/a", "/b"])


class Instructions(unittest.TestCase):
    def test_what_cargo_and_callgrind_say_is_understood(self):
        lines = [
            '{"reason":"compiler-artifact","target":{"name":"kutzbach"},"executable":null}',
            '{"reason":"compiler-artifact","target":{"name":"instructions"},"executable":"/x/instructions-1"}',
            '{"reason":"build-finished","success":true}',
        ]
        self.assertEqual(instructions.executable(lines), "/x/instructions-1")
        self.assertEqual(instructions.collected("==1== Events    : Ir\n==1== Collected : 1234\n"), 1234)
        with self.assertRaises(SystemExit):
            instructions.collected("valgrind: no such program")

    def test_counts_are_shown_with_three_digits(self):
        shown = [instructions.shown(x) for x in (123, 45_678, 1_234_567, 45_678_901, 2_345_678_901)]
        self.assertEqual(shown, ["123", "45,700", "1.23 million", "45.7 million", "2,350 million"])

    def test_the_page_shows_the_record(self):
        page = instructions.PAGE.read_text(encoding="utf-8")
        self.assertEqual(instructions.replaced(page, instructions.kept()), page, "python3 benches/instructions.py --page")

    def test_sweeps_are_shown_by_family(self):
        counts = {"rank of a file/robot": 6_051_400, "rank of a row/robot": 2_217_000, "rank of a file/six legs": 900, "rank of a row/six legs": 400}
        shown = instructions.sweeps(counts).splitlines()
        self.assertEqual(shown[0], "| family | rank of a file | rank of a row |")
        self.assertEqual(shown[1:], ["|---|---|---|", "| robot | 6,051 | 2,217 |", "| six legs | 1 | 0 |"])

    def test_a_page_without_its_markers_is_refused(self):
        for page in ("", instructions.BEGIN, instructions.END):
            with self.assertRaises(SystemExit):
                instructions.replaced(page, instructions.kept())


if __name__ == "__main__":
    unittest.main()
