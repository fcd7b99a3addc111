# SPDX-License-Identifier: Apache-2.0
"""Designs: keys from the program's description, values checked when assigned, the program's sentences as errors."""

import copy

import degs
import numpy
import pytest
from degs.design import keys_of, resolved, schema


@pytest.mark.parametrize("name", ["degs-1024", "degs-64-tuned", "gscore-256", "gbu-16", "gcc-64", "orange-o4"])
def test_a_shipped_design_reads_back_every_key(name):
    design = degs.Design(name)
    names = [name for name, _ in keys_of(schema()["$defs"][design.accelerator])]
    assert len(names) > 100
    again = degs.Design(design.accelerator)
    for name in names:
        if name != "accelerator":
            again[name] = design[name]
    assert again.yaml() == design.yaml()


def test_no_method_hides_a_key():
    for accelerator in schema()["$defs"]["degs"]["properties"]["accelerator"]["enum"]:
        node = resolved(schema()["$defs"][accelerator])
        assert not set(node["properties"]) & {name for name in dir(degs.Design) if not name.startswith("_")}


def test_keys_are_attributes_and_items():
    design = degs.Design("degs-64")
    assert design.span.count == 8 and design["span.count"] == 8 and design.span.parsing is True
    assert design.pipeline.rules.antialiasing == "scene" and design.clock_ghz == 1.0
    design.span.count = numpy.int64(16)
    design["memory.bandwidth_gb_per_s"] = 102.4
    design.packing = {"bytes": "16KB"}
    design.span.parsing = False
    assert design.span.count == 16 and design.packing.bytes == 16384 and design.span.parsing is False
    assert design.changes == {"span.count": 16, "memory.bandwidth_gb_per_s": 102.4, "packing.bytes": "16KB",
                              "span.parsing": False}
    assert "crossbar_depth" in dir(design.span) and "include" not in dir(design.span) and "span" in dir(design)
    assert not hasattr(design, "no_such_section") and hasattr(design.span, "count")
    assert "count: 16" in repr(design.span) and repr(design).startswith("Design(degs-64, span.count=16")
    assert "solve rows" in design.span._repr_html_()


@pytest.mark.parametrize("path, value, sentence", [
    ("span.cuont", 3, "key 'span.cuont' is unknown, did you mean 'span.count'?"),
    ("spam", 3, "key 'spam' is unknown, did you mean 'span'?"),
    ("span.count", 0, "must be an integer in decimal digits, 1 to 256"),
    ("span.count", 2.5, "must be an integer in decimal digits, 1 to 256"),
    ("span.count", True, "must be an integer in decimal digits, 1 to 256"),
    ("span.count", float("nan"), "must be an integer in decimal digits, 1 to 256"),
    ("span.parsing", 1, "must be true or false"),
    ("clock_ghz", 20, "key 'clock_ghz' is '20', but must be"),
    ("packing.bytes", "8XB", "the unit 'XB' does not fit key 'packing.bytes'"),
    ("scheduler.termination", "never", "must be"),
    ("span", 3, "key 'span'"),
    ("include", "x", "include"),
    ("accelerator", "gbu", "A design keeps its accelerator"),
])
def test_a_wrong_key_or_value_is_refused_when_it_is_assigned(path, value, sentence):
    design = degs.Design("degs-64")
    with pytest.raises(degs.Error) as caught:
        design[path] = value
    assert sentence in str(caught.value) and "\n" not in str(caught.value)
    assert design.changes == {}
    assert caught.value._render_traceback_() == [f"degs.Error: {caught.value}"]


def test_reading_an_unknown_key_says_which_are_near():
    design = degs.Design("degs-64")
    for read in (lambda: design.span.cuont, lambda: design["span.cuont"], lambda: design.describe("span.cuont")):
        with pytest.raises(degs.Missing, match="did you mean 'span.count'"):
            read()
    with pytest.raises(AttributeError, match="belongs to the design itself"):
        design.copy = 3


def test_rules_between_keys_are_checked_together():
    design = degs.Design("degs-64")
    design.scheduler.reuse_cycles = 1  # Only array.writeback_cycles, which may follow, decides whether it can be.
    with pytest.raises(degs.Error, match="must be at least 4 to cover array.writeback_cycles"):
        design.check()
    design.array.writeback_cycles = 1
    assert design.check() is design
    design.packing.bytes = "8GB"  # A number with a unit is in its range or not for the program.
    with pytest.raises(degs.Error, match="packing.bytes"):
        design.check()


def test_a_refused_update_changes_nothing():
    design = degs.Design("degs-64")
    with pytest.raises(degs.Error):
        design.update({"span.count": 16, "span.cuont": 3})
    assert design.changes == {}


def test_copies_are_independent():
    design = degs.Design("degs-64")
    others = [design.copy(), copy.copy(design), copy.deepcopy(design), design.with_({"span.count": 4}),
              design.with_(span={"count": 4}, clock_ghz=0.5)]
    others[0].span.count = 2
    assert [each.span.count for each in (design, *others)] == [8, 2, 8, 8, 4, 4]
    assert others[-1].clock_ghz == 0.5


def test_yaml_and_diff(tmp_path):
    design = degs.Design("degs-64").with_({"span.count": 16})
    file = tmp_path / "mine.yaml"
    file.write_text(design.yaml())
    assert degs.Design(file).span.count == 16 and design.diff(file).empty
    assert design.diff("degs-64").to_dict("index") == {"span.count": {"self": "16", "other": "8"}}
    assert design.diff("gscore-64").loc["tile_size"].to_dict() == {"self": "32", "other": "-"}
    assert design.describe("span").loc["span.count", "value"] == 16
    assert design.describe("span.count").loc["span.count", "value"] == 16
    assert design.blocks().loc["span", "mm2"] > degs.Design("degs-64").blocks().loc["span", "mm2"]


def test_accelerators_and_sizes():
    assert degs.Design("gscore").accelerator == "gscore"
    design = degs.Design("degs", pes=128)
    assert design.scheduler.banks * design.array.pes_per_bank == 128
    with pytest.raises(degs.Error, match="3"):
        degs.Design("degs", pes=3)


def test_a_design_that_does_not_exist(tmp_path):
    with pytest.raises(degs.Error, match="no design 'degs-46'.*did you mean 'degs-64'"):
        degs.Design("degs-46")
    with pytest.raises(degs.Error, match="cannot be read: No such file"):
        degs.Design("nothing.yaml")
    (tmp_path / "bad.yaml").write_text("span: {cuont: 3}\n")
    with pytest.raises(degs.Error, match=r"bad.yaml:1: key 'span.cuont' is unknown"):
        degs.Design(tmp_path / "bad.yaml")


def test_keys_without_effect_warn():
    with pytest.warns(degs.DegsWarning, match="'memory.latency_ns' has no effect") as caught:
        degs.Design("degs-64").with_({"memory.model": "lpddr5", "memory.latency_ns": 30}).check()
    assert caught[0].filename == __file__


def test_settings_as_reports_write_them():
    design = degs.Design("degs-64")
    other = design.with_settings("memory.bandwidth_gb_per_s=51.2,scheduler.termination=pixel,monitor.cancel=false")
    assert other.changes == {"memory.bandwidth_gb_per_s": 51.2, "scheduler.termination": "pixel",
                             "monitor.cancel": False}
    assert design.with_settings("packing.bytes=16KB").packing.bytes == 16384
    for settings, sentence in (("span.cuont=2", "did you mean"), ("monitor.cancel=perhaps", "monitor.cancel"),
                               ("span.count=0", "1 to 256"), ("span.count", "span.count")):
        with pytest.raises(degs.Error, match=sentence):
            design.with_settings(settings)
