# SPDX-License-Identifier: Apache-2.0
"""A kernel as a notebook has it: completion, pictures, and errors without tracebacks."""

import jupyter_client
import pytest
from conftest import ROOT, SCENE


@pytest.fixture(scope="module")
def kernel():
    """A client of a kernel that has imported the package and made a design."""
    manager, client = jupyter_client.manager.start_new_kernel(cwd=str(ROOT / "python"), startup_timeout=60)
    ask(client, "import degs; design = degs.Design('degs-64')")
    ask(client, f"report = degs.run(design, {SCENE!r}, width=48)")
    yield client
    client.stop_channels()
    manager.shutdown_kernel(now=True)


def ask(client, code):
    """All messages of the execution of `code`."""
    messages = []
    client.execute_interactive(code, timeout=60, output_hook=messages.append, allow_stdin=False)
    return messages


def completions(client, code):
    """What the kernel completes `code` to."""
    return client.complete(code, reply=True, timeout=60)["content"]["matches"]


def test_keys_and_numbers_complete(kernel):
    assert {name.rsplit(".", 1)[-1] for name in completions(kernel, "design.span.")} >= {"count", "parsing", "rows"}
    assert [name.rsplit(".", 1)[-1] for name in completions(kernel, "design.span.cou")] == ["count"]
    assert {name.rsplit(".", 1)[-1] for name in completions(kernel, "design.pipeline.rules.")} >= {"low_pass", "cut"}
    assert {name.rsplit(".", 1)[-1] for name in completions(kernel, "report.energy.")} >= {"nj_per_frame", "dram_nj"}
    assert {name.rsplit(".", 1)[-1] for name in completions(kernel, "report.")} >= {"cycles", "image", "slots"}


def test_a_report_shows_its_picture(kernel):
    shown = [each for each in ask(kernel, "report") if each["msg_type"] == "execute_result"]
    assert set(shown[0]["content"]["data"]) == {"text/plain", "text/html", "image/png"}


def test_an_error_is_one_line(kernel):
    errors = [each for each in ask(kernel, "design.span.count = 0") if each["msg_type"] == "error"]
    assert len(errors[0]["content"]["traceback"]) == 1
    assert errors[0]["content"]["traceback"][0].startswith("degs.Error: --set span.count=0: key 'span.count' is '0'")
