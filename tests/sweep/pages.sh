#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# pages.sh PROGRAM CONFIGS [--one]: opens the pages of a sweep and of a comparison in headless
# Chromium, 390 and 1400 px wide, dark and light, uses them, and fails for any message on the
# console. With --one, only the page of the sweep, wide and dark. Exits with 77 if there is no
# Chromium.
set -euo pipefail
program=$1 configs=$2 widths=(390 1400) schemes=(0 1) # dark, light
[[ ${3:-} != --one ]] || { widths=(1400) schemes=(0); }
command -v chromium >/dev/null || { echo "skipped: chromium is not installed (scripts/install.sh --tests)"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

cat >"$folder/study.yaml" <<YAML
study: <buffers> & "more"
designs:
  - include: $configs/degs-64.yaml
    name: degs-64
axes:
  gaussian_buffer.bytes: x1/2..x2 x2
  pixel_buffer.bytes: [4KB, 16KB]
  scheduler.termination: [segment, pixel]
scenes: [synthetic:single, "synthetic:object,gaussians=300"]
width: 64
YAML
"$program" sweep "$folder/study.yaml" --out "$folder/sweep" >/dev/null 2>&1
cat >"$folder/linked.yaml" <<YAML
study: linked
designs:
  - include: $configs/degs-64.yaml
    name: degs-64
axes:
  shape: {keys: {scheduler.banks: [4, 8, 16], array.pes_per_bank: [16, 8, 4]}}
  memory.bandwidth_gb_per_s: 51.2..204.8 x2
scenes: synthetic:single
width: 64
YAML
"$program" sweep "$folder/linked.yaml" --out "$folder/linked" >/dev/null 2>&1
"$program" compare "$configs/degs-16.yaml" "$configs/gscore-16.yaml" --scene synthetic:object,gaussians=300 \
    --width 64 --out "$folder/compare" >/dev/null 2>&1

# The page in a frame of a given width, used like a reader would; the last line of the document says
# what was seen.
cat >"$folder/use.html" <<'HTML'
<!doctype html><title>use</title><body style="margin:0"><iframe id="page" style="height:900px;border:0"></iframe>
<pre id="seen"></pre><script>
const wish = new URLSearchParams(location.search);
const frame = document.getElementById("page");
frame.style.width = wish.get("width") + "px";
const wait = () => new Promise((done) => setTimeout(done, 300));
frame.onload = async () => {
  const doc = frame.contentDocument;
  const at = (id) => doc.getElementById(id);
  const rows = () => at("table").tBodies[0].rows.length;
  const put = (id, value, kind) => { at(id).value = value; at(id).dispatchEvent(new Event(kind)); };
  await wait();
  const seen = { rows: rows(), plots: doc.querySelectorAll("svg").length };
  for (const select of ["x", "y", "colour", "view"]) {
    for (const option of at(select).options) { put(select, option.value, "change"); }
  }
  await wait();
  seen.all = [...at("view").options].some((o) => o.value === "all") ? (put("view", "all", "change"), rows()) : rows();
  // The mean over the views is the geometric one of what the views show, a row for each design.
  const named = (name) => [...doc.querySelectorAll("th")].findIndex((th) => th.textContent.startsWith(name));
  const latency = (view) => { put("view", view, "change"); return Number(at("table").tBodies[0].rows[0].cells[named("latency_ms")].title); };
  const has = [...at("view").options].some((o) => o.value === "mean");
  const [one, two, mean] = has ? ["0", "1", "mean"].map(latency) : [1, 1, 1];
  seen.mean = has ? `${rows()}${Math.abs(mean * mean / (one * two) - 1) < 1e-9 && one !== two ? " geometric" : ""}` : "none";
  if (has) { put("view", "all", "change"); }
  at("all-columns").click();
  doc.querySelectorAll("th button").forEach((button) => { button.click(); });
  doc.querySelector("th button").click();
  put("filter", "point<=2", "input");
  seen.filtered = rows();
  put("filter", "nonsense<1", "input");
  seen.note = at("filter-note").textContent;
  put("filter", "", "input");
  await wait();
  // The buttons save two charts with their legends, and the rows under their headings. What a file
  // would hold is taken where it is made: reading it back from a Blob takes real time, which the
  // clock of --virtual-time-budget does not wait for.
  const texts = [];
  frame.contentWindow.Blob = function (parts) { texts.push(parts.join("")); };
  frame.contentWindow.URL.createObjectURL = () => "#";
  frame.contentWindow.HTMLAnchorElement.prototype.click = () => {};
  put("colour", "design", "change");
  doc.querySelectorAll("[data-svg], #save-csv").forEach((button) => { button.click(); });
  const charts = texts.slice(0, 2).map((text) => new DOMParser().parseFromString(text, "image/svg+xml"));
  seen.charts = charts.filter((chart) => chart.documentElement.tagName === "svg" && chart.querySelector("desc")
    && chart.documentElement.textContent.includes(chart === charts[0] ? wish.get("design") : "useful")).length;
  seen.saved = texts[2].trim().split("\n").length - 1;
  seen.wider = doc.documentElement.scrollWidth - frame.clientWidth;
  seen.links = doc.querySelectorAll("td a[href^='reports/']").length;
  document.getElementById("seen").textContent = JSON.stringify(seen);
};
frame.src = wish.get("page");
</script></body>
HTML

failed=0
try() { # PAGE ROWS ALL DESIGN MEAN
    local page=$1 width scheme log dom seen
    for width in "${widths[@]}"; do
        for scheme in "${schemes[@]}"; do
            log=$folder/log dom=$folder/dom
            chromium --headless --no-sandbox --disable-gpu --allow-file-access-from-files --user-data-dir="$folder/user" \
                --blink-settings=preferredColorScheme=$scheme --enable-logging=stderr --v=0 --window-size=1500,1000 \
                --virtual-time-budget=20000 --dump-dom "file://$folder/use.html?page=$page/index.html&width=$width&design=$4" \
                >"$dom" 2>"$log"
            seen=$(grep -o '<pre id="seen">.*</pre>' "$dom" | sed 's/<[^>]*>//g; s/&[a-z]*;//g' || true)
            echo "$page, $width px, scheme $scheme: $seen"
            if grep CONSOLE "$log"; then failed=1; fi
            [[ $seen == *"\"rows\":$2,"* && $seen == *"\"mean\":\"$5\","* && $seen == *"\"all\":$3,"* && $seen == *'"filtered":2,'* &&
                $seen == *'"charts":2,'* && $seen == *"\"saved\":$3,"* &&
                $seen == *'no column for nonsense'* && $seen =~ \"wider\":(-[0-9]+|0), && $seen == *"\"links\":$3}"* &&
                ! $seen =~ \"plots\":[01], ]] || { echo "this page is not as it should be"; failed=1; }
        done
    done
}
try sweep 6 12 degs-64 '6 geometric'
[[ ${3:-} != --one ]] || exit "$failed"
try compare 2 2 gscore-16 none
# Linked keys are one axis, and ticks are the values themselves.
chromium --headless --no-sandbox --disable-gpu --user-data-dir="$folder/user" --window-size=1500,1000 \
    --virtual-time-budget=20000 --dump-dom "file://$folder/linked/index.html" >"$folder/dom" 2>/dev/null
for text in 'latency_ms over shape' '>4, 16</text>' '>8, 8</text>' '>16, 4</text>' '>204.8</text>' '>102.4</text>'; do
    grep -qF -- "$text" "$folder/dom" || { echo "the page of linked keys has no $text"; failed=1; }
done
# Three goals are lines across parallel axes: four designs, of which some break the limit.
cat >"$folder/goals.yaml" <<YAML
study: goals
designs:
  - include: $configs/degs-64.yaml
    name: degs-64
axes:
  span.count: [4, 8]
  packing.bytes: [x1, x2]
goals: [latency_ms, area_mm2, energy.nj_per_frame]
limits: area_mm2<=baseline
scenes: synthetic:single
width: 64
YAML
"$program" sweep "$folder/goals.yaml" --out "$folder/goals" >/dev/null 2>&1
chromium --headless --no-sandbox --disable-gpu --user-data-dir="$folder/user" --window-size=1500,1000 --enable-logging=stderr \
    --v=0 --virtual-time-budget=20000 --dump-dom "file://$folder/goals/index.html" >"$folder/dom" 2>"$folder/log"
if grep CONSOLE "$folder/log"; then failed=1; fi
for part in 'path class="design:4' 'class="design front:1' 'class="design outside":1' 'class="outside":1'; do
    found=$(grep -oF -- "${part%:*}" "$folder/dom" | wc -l)
    ((found >= ${part##*:})) || { echo "the page of goals has ${part%:*} $found times"; failed=1; }
done
! grep -oE '(src|href)="https?:[^"]*"|@import|url\(["'\'']?http' "$folder"/*/index.html || { echo "a page needs a network"; failed=1; }
exit "$failed"
