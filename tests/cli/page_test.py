"""The pages of `ptbench report` and `ptbench compare`, in a real browser without a network."""

import copy
import json
import os
import pathlib
import shutil
import unittest

from browser import Browser
from ptbench import TINY, Scratch, changed, undisturbed

SHOTS = pathlib.Path(os.environ["PTB_BINARY_DIR"]) / "page"
READY = "document.documentElement.classList.contains('ready')"
HOSTILE = "</script><img src=x onerror=window.owned=1>\"'&{{7*7}}\x1b[31m\u202e,=1+1|`"
SCRATCH, BROWSER = None, None


def setUpModule():
    """One real run of two devices, and the same as if nothing had disturbed it; one browser for all tests."""
    global SCRATCH, BROWSER
    SCRATCH = Scratch()
    unittest.addModuleCleanup(SCRATCH.remove)
    words = changed(TINY, spp="2,5,9", size="64", samples=9)
    ran = SCRATCH.run(*words, "--out", "live", "--html", "live.html", "-q", timeout=120)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    shutil.copytree(SCRATCH.work / "live", SCRATCH.work / "out")
    result = undisturbed(SCRATCH.result("live"))
    result["fits"] = [{"params": case["params"], "points": 3, "overhead_ms": 0.1, "ms_per_spp": 0.1, "r2": 1, "warning": ""}
                      for case in result["cases"] if case["params"]["spp"] == 9]
    SCRATCH.write("out/result.json", result)
    page_of("report", "out/result.json").rename(SCRATCH.work / "page.html")
    SHOTS.mkdir(exist_ok=True)
    BROWSER = Browser()
    unittest.addModuleCleanup(BROWSER.close)


def variant(name, change):
    """The run with another content."""
    result = copy.deepcopy(SCRATCH.result())
    change(result)
    return SCRATCH.write(f"out/{name}.json", result)


def page_of(*words, code=0):
    ran = SCRATCH.run(*words, "--html", "made.html")
    assert ran.returncode == code, ran.stdout + ran.stderr
    return SCRATCH.work / "made.html"


def show(file, width=1280, scheme="light"):
    BROWSER.look(width, scheme)
    return BROWSER.open(file, READY)


def texts(selector):
    return BROWSER.evaluate(f"[...document.querySelectorAll({json.dumps(selector)})].map((e) => e.textContent)")


def column(title):
    """Cells of the visible rows of the times under a heading."""
    return BROWSER.evaluate(f"""(() => {{
        const table = document.querySelector('#times table');
        const at = [...table.tHead.rows[0].cells].findIndex((c) => c.textContent === {json.dumps(title)});
        return [...table.tBodies[0].rows].filter((r) => !r.hidden).map((r) => r.cells[at].textContent);
    }})()""")


def four_digits(number):
    """As the table writes times, by another hand."""
    return f"{number:.{3 if number < 10 else max(0, 4 - len(str(int(number))))}f}"


class Page(unittest.TestCase):
    def assert_clean(self):
        self.assertEqual(BROWSER.complaints(), [])
        outside = [url for url in BROWSER.requests() if not url.startswith(("file://", "data:", "blob:"))]
        self.assertEqual(outside, [])
        self.assertEqual(len([url for url in BROWSER.requests() if url.startswith("file://")]), 1)

    def test_the_live_page_and_that_of_the_stored_run_are_the_same(self):
        self.assertEqual(page_of("report", "live/result.json").read_bytes(), (SCRATCH.work / "live.html").read_bytes())

    def test_terminal_and_formats_are_those_of_the_run(self):
        for flag, name in (("--md", "table.md"), ("--csv", "result.csv"), ("--json", "result.json")):
            shown = SCRATCH.run("report", "live/result.json", flag, "-").stdout
            self.assertEqual(shown, (SCRATCH.work / "live" / name).read_text())
        table = SCRATCH.run("report", "live/journal.jsonl").stdout
        self.assertIn("times, scene thesis", table)

    def test_a_page_of_a_run_is_clean_in_both_schemes_and_on_a_phone(self):
        for width, scheme in ((1280, "light"), (1280, "dark"), (380, "light"), (380, "dark")):
            with self.subTest(width=width, scheme=scheme):
                show(SCRATCH.work / "page.html", width, scheme)
                self.assert_clean()
                self.assertLessEqual(BROWSER.evaluate("document.documentElement.scrollWidth"), width)
                ground = BROWSER.evaluate("getComputedStyle(document.body).backgroundColor")
                self.assertEqual(ground == "rgb(255, 255, 255)", scheme == "light")
                drawn = BROWSER.evaluate("""[...document.querySelectorAll('#charts canvas')].map((canvas) => canvas
                    .getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.some((value) => value > 0))""")
                self.assertEqual(drawn, [True] * 4)
                BROWSER.screenshot(SHOTS / f"{width}-{scheme}.png")

    def test_numbers_are_those_of_the_result_file(self):
        show(SCRATCH.work / "page.html")
        expected = [four_digits(case["statistics"]["median_ns"] / 1e6) for case in SCRATCH.result()["cases"]]
        self.assertEqual(column("time ms")[:len(expected)], expected)
        self.assertEqual(column("time ms")[-9:], ["2589", "27655", "269815", "3492", "33215", "312652", "10322",
                                                  "130246", "1405217"])
        self.assertEqual(set(column("run")[-9:]), {"2016"})

    def test_a_roofline_has_the_measured_roofs_and_each_kernel_in_words_too(self):
        def count(result):
            first = result["cases"][0]
            names = {"fma": 100, "global": 20}
            result["peaks"] = [{"device": first["params"]["device"], "reason": "", "peaks": [
                {"name": name, "unit": "", "value": value, "low": None, "high": None, "n": 10, "timer": "event",
                 "reason": ""} for name, value in names.items()]}]
            first["statistics"]["msegments_per_s"] = 150
            first["counted"] = {
                "segments": 1000, "flops_per_segment": 200, "roots_per_segment": 10, "divisions_per_segment": 0,
                "bytes_per_segment": 4, "lanes_alive": 0.75, "reason": "",
                "of_peak": {"fma": 0.3, "sqrt": None, "division": None, "global": 0.03, "limit": "fma",
                            "limit_share": 0.3}}

        file = page_of("report", str(variant("roofline", count)))
        for width, scheme in ((1280, "light"), (1280, "dark"), (380, "light"), (380, "dark")):
            show(file, width, scheme)
            self.assert_clean()
            self.assertLessEqual(BROWSER.evaluate("document.documentElement.scrollWidth"), width)
            BROWSER.screenshot(SHOTS / f"roofline-{width}-{scheme}.png")
        words = BROWSER.evaluate("[...document.querySelectorAll('#charts canvas')].map((c) => c.ariaLabel)")
        (roofline,) = [text for text in words if text.startswith("Roofline of")]
        kernel = SCRATCH.result()["cases"][0]["params"]["kernel"]
        self.assertIn("at most 100 GFLOP/s and 20.0 GB/s", roofline)
        self.assertIn(f"{kernel} 30.0 GFLOP/s at 50.0 flops a byte; nearest limit fma, 30.0 %", roofline)
        sets = BROWSER.evaluate("""[...document.querySelectorAll('#charts canvas')].map((c) => Chart.getChart(c))
            .find((chart) => chart.data.datasets[0].label.startsWith('roofs')).data.datasets.map((set) => set.data)""")
        self.assertEqual(sets[0], [{"x": 1, "y": 20}, {"x": 5, "y": 100}, {"x": 100, "y": 100}])
        self.assertEqual([(place["x"], place["y"]) for place in sets[1]], [(50, 30)])

    def board(self):
        """Rows of the ranking that is shown, without what their numbers are unsure by."""
        return BROWSER.evaluate("""[...document.querySelectorAll('.ranking')].filter((e) => e.offsetParent).flatMap((e) =>
            [...e.querySelectorAll('tbody tr')].map((row) => [row.cells[1].textContent, row.cells[3].firstChild.textContent.trim()]))""")

    def test_a_page_opens_with_a_ranking_that_another_takes_the_place_of_by_a_click(self):
        show(SCRATCH.work / "page.html")
        first = BROWSER.evaluate("document.querySelector('main section').id")
        self.assertEqual(first, "board")
        rows = self.board()
        cases = [case for case in SCRATCH.result()["cases"] if case["params"]["spp"] == 9]
        best = sorted((case["statistics"]["msegments_per_s"] for case in cases), reverse=True)
        self.assertEqual([value for _, value in rows if value], [four_digits(rate) for rate in best])
        tops = BROWSER.evaluate("['board', 'pictures', 'verdict'].map((id) => document.getElementById(id).offsetTop)")
        self.assertEqual(tops, sorted(tops))
        BROWSER.evaluate("document.querySelectorAll('.rankings label')[1].click()")
        self.assertNotEqual(self.board(), rows)
        self.assertEqual(BROWSER.evaluate("document.querySelectorAll('.rankings input:checked').length"), 1)

    def test_devices_of_2016_have_their_place(self):
        def as_the_thesis(result):
            for case in result["cases"]:
                case["params"].update(path_length=128)
                case["statistics"]["msegments_per_s"] = 100
            first = result["cases"][0]
            first["params"].update(kernel="thesis", spp=10)
            first["work"].update(samples=1000, segments=33000)

        show(page_of("report", variant("thesis", as_the_thesis)))
        names = [name for name, _ in self.board()]
        self.assertEqual(names[0], "Radeon R9 290X (2016)")
        self.assertEqual(names[-1], "FX-6300 Vishera (2016)")
        self.assertEqual(self.board()[0][1], "128.2")  # 1024^2 x 1000 samples of 33 segments in 269.815 s

    def test_sorting_and_filtering(self):
        show(SCRATCH.work / "page.html")
        press = "document.querySelectorAll('#times th button')[4].click()"
        for order in (1, -1):
            BROWSER.evaluate(press)
            times = [float(cell) for cell in column("time ms")]
            self.assertEqual(times, sorted(times, reverse=order < 0))
        self.assertEqual(BROWSER.evaluate("document.querySelectorAll('#times th')[4].ariaSort"), "descending")
        BROWSER.evaluate("""(() => { const box = document.querySelector('#times input');
                            box.value = 'Radeon 1000'; box.dispatchEvent(new Event('input')); })()""")
        self.assertEqual(column("time ms"), ["269815"])
        self.assertEqual(texts("#times output"), ["1 of 15 rows"])

    def test_a_legend_wraps_on_a_phone_and_its_buttons_hide_lines_with_their_fits(self):
        def name(result):
            for device in result["devices"]:
                device["name"] = f"{device['key']} of a rather long name that takes more than one line of a phone"
        show(page_of("report", variant("long", name)), 380)
        self.assertLessEqual(BROWSER.evaluate("document.documentElement.scrollWidth"), 380)
        cut = "[...document.querySelectorAll('.legend li')].some((li) => li.scrollWidth > li.parentNode.clientWidth)"
        self.assertFalse(BROWSER.evaluate(cut))
        visible = """(() => { const chart = Chart.getChart(document.querySelectorAll('#charts canvas')[1]);
            return chart.data.datasets.map((set, i) => [set.label !== '', chart.isDatasetVisible(i)]); })()"""
        press = "document.querySelectorAll('#charts figure')[1].querySelector('.legend button').click()"
        self.assertEqual(BROWSER.evaluate(visible), [[True, True], [False, True]] * 2)
        BROWSER.evaluate(press)
        self.assertEqual(BROWSER.evaluate(visible), [[True, False], [False, False], [True, True], [False, True]])
        self.assertEqual(BROWSER.evaluate("document.querySelectorAll('.legend [aria-pressed=false]').length"), 1)
        BROWSER.screenshot(SHOTS / "legend.png")
        BROWSER.evaluate(press)
        self.assertEqual(BROWSER.evaluate(visible), [[True, True], [False, True]] * 2)

    def test_a_row_leads_to_its_case_which_unfolds(self):
        show(SCRATCH.work / "page.html")
        BROWSER.evaluate("document.querySelectorAll('#times td a')[1].click()")
        BROWSER.evaluate("new Promise((resolve) => setTimeout(resolve, 100))")
        case = SCRATCH.result()["cases"][1]
        shown = "\n".join(texts("details[open]#r0c1"))
        for part in (str(case["statistics"]["median_ns"]).removesuffix(".0"), case["build"]["kernel_hash"],
                     case["validation"]["against"]):
            self.assertIn(part, shown)

    def test_the_slider_wipes(self):
        show(SCRATCH.work / "page.html")
        self.assertEqual(len(texts("#pictures img")), 3 * 2 - 1 + 2)
        self.assertTrue(BROWSER.evaluate("[...document.images].every((i) => i.complete && i.naturalWidth >= 64)"))
        BROWSER.evaluate("""(() => { const slider = document.querySelector('#wipe input');
                            slider.value = 20; slider.dispatchEvent(new Event('input')); })()""")
        clip = BROWSER.evaluate("getComputedStyle(document.querySelector('.wipe img + img')).clipPath")
        self.assertEqual(clip, "inset(0px 0px 0px 20%)")

    def test_the_download_is_the_result_file(self):
        show(SCRATCH.work / "live.html")
        text = BROWSER.evaluate("unpack(document.querySelector('script.data')).then(fileText)")
        self.assertEqual(text, (SCRATCH.work / "live/result.json").read_text())

    def test_without_scripts_tables_and_pictures_are_there(self):
        BROWSER.call("Emulation.setScriptExecutionDisabled", value=True)
        try:
            BROWSER.open(SCRATCH.work / "page.html")
            self.assertEqual(len(texts("#times tbody tr")), 15)
            self.assertEqual(len(texts(".pictures img")), 5)
            self.assertIn("fastest of 2 devices", "".join(texts("#verdict")))
            shown = BROWSER.evaluate("[...document.querySelectorAll('.ranking')].map((e) => e.offsetParent !== null)")
            self.assertEqual(shown, [True] + [False] * (len(shown) - 1))
            for i, case in enumerate(SCRATCH.result()["cases"]):
                shown = "".join(texts(f"#r0c{i} dd"))
                self.assertIn(f"median {four_digits(case['statistics']['median_ns'] / 1e6)}", shown)
                self.assertIn(case["build"]["kernel_hash"], shown)
                self.assertIn(f"right, against {case['validation']['against']}", shown)
            BROWSER.evaluate("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
            BROWSER.look(380, "light")
            self.assertLessEqual(BROWSER.evaluate("document.documentElement.scrollWidth"), 380)
            BROWSER.screenshot(SHOTS / "without-scripts.png", scripted=False)
        finally:
            BROWSER.call("Emulation.setScriptExecutionDisabled", value=False)

    def test_several_runs_share_a_page_with_their_history(self):
        def later(result):
            result["run"]["started_at"] = "2031-01-01T00:00:00Z"
            for case in result["cases"]:
                case["statistics"]["median_ns"] *= 2
        show(page_of("report", "out/result.json", variant("later", later)))
        self.assert_clean()
        self.assertEqual(len(column("run")), 2 * 6 + 9)
        self.assertEqual(len([run for run in column("run") if run.startswith("later.json, 2031-01-01 00:00")]), 6)
        self.assertIn("Time of the same case over the dates", "".join(texts("#charts figcaption")))

    def test_several_runs_begin_with_a_table_that_leads_to_them(self):
        show(page_of("report", "out/result.json", variant("second", lambda result: None)))
        self.assertEqual([text.split(",")[0] for text in texts("#verdict td:first-child")], ["result.json", "second.json"])
        BROWSER.evaluate("document.querySelectorAll('#verdict td a')[1].click()")
        self.assertIn("second.json", texts(":target")[0])

    def test_devices_of_several_runs_have_parts_of_their_own(self):
        def other(result):
            for device in result["devices"]:
                device["name"] = "another " + device["name"]
            result["pictures"] = []

        show(page_of("report", "out/result.json", variant("another", other)))
        self.assert_clean()
        self.assertEqual(len(texts("#devices > h3")), 2)
        self.assertEqual(len(texts("#devices > h4")), 2)
        self.assertEqual(BROWSER.evaluate("[...document.querySelectorAll('.charts-of')].map((e) => e.querySelectorAll('canvas').length > 0)"),
                         [True, True])
        links = BROWSER.evaluate("""[...document.querySelectorAll('#rank-0 ~ .ranking a')].map((a) =>
            [a.textContent, document.querySelector(a.hash).textContent])""")
        self.assertTrue(links)
        for device, part in links:
            self.assertIn(device, part)
        show(SCRATCH.work / "made.html", 380, "dark")
        self.assertLessEqual(BROWSER.evaluate("document.documentElement.scrollWidth"), 380)
        BROWSER.screenshot(SHOTS / "devices.png")

    def test_a_swept_axis_has_bars_and_says_what_has_no_time(self):
        def sweep(result):
            for case, length in zip(result["cases"], (2, 3, 4) * 2):
                case["params"].update(spp=10, path_length=length)
            result["cases"][1].update(status="unsupported", reason=HOSTILE, statistics=None)
            result["cases"][4].update(status="invalid", reason="too bright", statistics=None)
        result_file = variant("sweep", sweep)
        show(page_of("report", result_file))
        self.assert_clean()
        cases = json.loads((SCRATCH.work / result_file).read_text())["cases"]
        (figure,) = [text for text in texts("#charts figcaption") if text.startswith("Time by path_length")]
        self.assertIn("No time for 3", figure)
        self.assertIn("invalid: too bright", figure)
        spoken = BROWSER.evaluate("""[...document.querySelectorAll('#charts canvas')].map((c) => c.ariaLabel)
            .find((label) => label.startsWith('Time by path_length'))""")
        bars = BROWSER.evaluate("""[...document.querySelectorAll('#charts canvas')].map((c) => Chart.getChart(c))
            .find((chart) => chart.config.type === 'bar').data.datasets.map((set) => set.data)""")
        self.assertEqual([[bar["x"] for bar in series] for series in bars], [["2", "4"], ["2", "4"]])
        for first, series in zip((0, 3), bars):
            times = [cases[first]["statistics"]["median_ns"], cases[first + 2]["statistics"]["median_ns"]]
            for bar, time in zip(series, times):
                self.assertAlmostEqual(bar["y"], time / min(times), places=9)
                self.assertEqual(bar["fastest"], time == min(times))
                self.assertIn(f"{bar['x']} {bar['y']:.2f}", spoken)
        self.assertEqual(sum("fastest" in row for row in texts("table.sweep tr.best")), 2)
        BROWSER.screenshot(SHOTS / "sweep.png")

    def test_hostile_text_is_text(self):
        def poison(result):
            for device in result["devices"]:
                device.update(name=HOSTILE, vendor=HOSTILE, excluded="")
            result["host"].update(hostname=HOSTILE, cpu=HOSTILE)
            result["run"].update(argv=[HOSTILE], config=HOSTILE, started_at=HOSTILE)
            result["warnings"] = [HOSTILE]
            result["cases"][0]["build"]["log"] = HOSTILE
            result["cases"][1].update(status="crash", reason=HOSTILE, statistics=None)
            result["cases"][2]["samples"][0]["cause"] = HOSTILE
            result["pictures"].append({"params": result["cases"][0]["params"], "file": "../" + HOSTILE})
        show(page_of("report", variant("hostile", poison)))
        BROWSER.evaluate("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
        BROWSER.evaluate("new Promise((resolve) => setTimeout(resolve, 300))")
        self.assert_clean()
        self.assertIsNone(BROWSER.evaluate("window.owned"))
        self.assertEqual(BROWSER.evaluate("[...document.images].filter((i) => !i.src.startsWith('data:')).length"), 0)
        self.assertIn("<img src=x onerror=window.owned=1>", "".join(texts("#verdict")))
        self.assertIn("not a name beside the result", "".join(texts("figcaption")))
        self.assertEqual(BROWSER.evaluate("document.body.innerText.match(/[\\x1b\\u202e]/g)"), None)

    def test_a_missing_picture_is_said(self):
        show(page_of("report", SCRATCH.write("alone/run.json", SCRATCH.result())))
        self.assertEqual(len([c for c in texts("figcaption") if "no picture: pocl-" in c]), 2)
        self.assert_clean()

    def test_a_comparison_has_a_forest_plot(self):
        def slower(result):
            for case in result["cases"]:
                for sample in case["samples"]:
                    sample.update(kernel_ns=3 * sample["kernel_ns"], host_ns=3 * sample["host_ns"])
        words = ("compare", "out/result.json", variant("slower", slower), "--gate-single-session")
        show(page_of(*words, code=3))
        self.assert_clean()
        self.assertIn("regressed: pt thesis 64x64 spp", texts("#verdict p")[0])
        self.assertEqual(len(texts("#changes svg.forest circle")), 6)
        BROWSER.screenshot(SHOTS / "compare.png")

    def test_a_fleet_has_a_strip_of_dots_and_a_table_that_can_be_filtered(self):
        words = (*changed(TINY, spp="2"), "-d", "pocl:1", "--expect", "n1", "--fleet", "fleet", "-q")
        ran = SCRATCH.run(*words, SLURMD_NODENAME="n1")
        self.assertEqual(ran.returncode, 0, ran.stderr)
        like = [json.loads(line) for line in (SCRATCH.work / "fleet/nodes/n1.jsonl").read_text().splitlines()]
        for node in range(1, 9):
            like[0]["host"]["node"] = f"n{node}"
            like[1]["statistics"]["median_ns"] = 1e6 * (1.2 if node == 5 else 1)
            SCRATCH.write(f"fleet/nodes/n{node}.jsonl", "".join(json.dumps(line) + "\n" for line in like))
        show(page_of("report", "fleet"))
        self.assert_clean()
        self.assertEqual(len(texts("#classes circle")), 8)
        self.assertEqual(texts("#classes .bad title"), ["n5/pocl:1 +20.0 % suspect, to be confirmed"])
        BROWSER.evaluate("""(() => { const box = document.querySelector('#cards input');
                            box.value = 'suspect'; box.dispatchEvent(new Event('input')); })()""")
        self.assertEqual(texts("#cards output"), ["1 of 8 rows"])
        BROWSER.screenshot(SHOTS / "fleet.png")


if __name__ == "__main__":
    unittest.main()
