// SPDX-License-Identifier: Apache-2.0
// The plots and the table of a study, from the JSON in the page.
"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const at = (id) => document.getElementById(id);
  const isNumber = (value) => typeof value === "number";
  const infinite = (value) => (value === "inf" ? Infinity : value);

  /** A number without what arithmetic adds to a decimal: 204.8, 0.3, 32 768. */
  const exact = (value) => {
    const short = Number(value.toPrecision(12));
    const magnitude = Math.abs(short);
    return magnitude !== 0 && (magnitude >= 1e15 || magnitude < 1e-4) ? short.toExponential()
      : Number.isInteger(short) && magnitude >= 10000 ? short.toLocaleString("en").replaceAll(",", "\u202f")
      : String(short);
  };

  // Columns: how a run's values are called, read and written.
  const keyColumns = data.keys.map((key, k) => {
    const texts = data.variants.map((v) => v.values[k]);
    const numeric = texts.every((t) => t === null || (t !== "" && !Number.isNaN(Number(t))));
    return { name: key, unit: "", kind: "key", numeric, keys: [k], sentence: "Key of the configuration.",
      of: (run) => { const t = data.variants[run.variant].values[k]; return numeric && t !== null ? Number(t) : t; } };
  });
  // Keys that change together are one axis, whose values are those of its keys: "8, 8". Its values stand in the order
  // of its first numeric key.
  const axisColumns = data.axes.map((axis) => ({
    name: axis.name, unit: "", kind: "axis", numeric: false, keys: axis.keys,
    sentence: `Keys that change together: ${axis.keys.map((k) => data.keys[k]).join(", ")}.`,
    of: (run) => axis.keys.map((k) => keyColumns[k].of(run)).map((v) => (isNumber(v) ? exact(v) : String(v)))
      .join(", ") }));
  const inAxis = new Set(data.axes.flatMap((axis) => axis.keys));
  const measureColumns = data.measures.map((m, i) => ({
    name: m.name, unit: m.unit, kind: "measure", numeric: true,
    sentence: m.better ? `${m.sentence} (${m.better})` : m.sentence,
    of: (run) => infinite(run.measures[i]) })).filter((c) => data.runs.some((run) => c.of(run) !== null));
  const stageNames = [...new Set(data.runs.flatMap((run) => Object.keys(run.stages)))];
  const stageColumns = stageNames.map((stage) => ({
    name: `stages.${stage}.busy`, unit: "share", kind: "measure", numeric: true,
    sentence: "Share of the run in which the units of this stage worked.", of: (run) => run.stages[stage] ?? null }));
  const partColumns = [...new Set(data.runs.flatMap((run) => Object.keys(run.parts)))].map((name) => ({
    name, unit: name.endsWith("_share") ? "share" : name.endsWith("high_water") ? "cells" : "nJ", kind: "measure",
    numeric: true, sentence: name.startsWith("buffers.") ? "Most cells of one ring filled at once."
      : "Dynamic energy and leakage of a block, per frame.", of: (run) => run.parts[name] ?? null }));
  const design = { name: "design", unit: "", kind: "text", numeric: false, sentence: "Design of the study.",
    of: (run) => data.variants[run.variant].design };
  const limit = { name: "limited_by", unit: "", kind: "text", numeric: false, sentence: "memory if memory_bound is more than a half, else the busiest stage.",
    of: (run) => run.limited_by };
  const meanWords = `geometric mean of ${data.views.length} views`;
  const view = { name: "view", unit: "", kind: "text", numeric: false, sentence: "Scene, camera and image size.",
    of: (run) => (run.view === null ? meanWords : data.views[run.view].words) };
  const point = { name: "point", unit: "", kind: "text", numeric: true, sentence: "Number of the point; its report.",
    of: (run) => run.point };
  const pes = { name: "pes", unit: "PEs", kind: "key", numeric: true, sentence: "Processing elements.",
    of: (run) => data.variants[run.variant].pes };
  const areMorePes = new Set(data.variants.map((v) => v.pes)).size > 1;
  const within = { name: "within", unit: "", kind: "text", numeric: false,
    sentence: "Whether the design is within the limits: yes, or the limits that it breaks.",
    of: (run) => data.variants[run.variant].within || null };
  const isOutside = (run) => data.limited && !["yes", ""].includes(data.variants[run.variant].within);
  const columns = [point, design, ...(data.limited ? [within] : []), ...axisColumns, ...keyColumns, ...(areMorePes ? [pes] : []), view, ...measureColumns, limit,
    ...stageColumns, ...partColumns];
  const columnOf = new Map(columns.map((c) => [c.name, c]));
  /** The rule of goals over several views: nothing where a view has no value, 0 where one has 0, ∞ where one has ∞. */
  const geometricMean = (values) => (values.some((v) => !isNumber(v) || v < 0) ? null
    : values.includes(Infinity) ? Infinity : values.includes(0) ? 0
    : values.every((v) => v === values[0]) ? values[0] : Math.exp(d3.mean(values, Math.log)));
  /** A design over all views as a run without a report; none where a view is missing. */
  const means = data.views.length < 2 ? [] : d3.groups(data.runs, (run) => run.variant)
    .filter(([, runs]) => runs.length === data.views.length).map(([variant, runs]) => {
      const named = (part) => Object.fromEntries(Object.keys(runs[0][part])
        .map((name) => [name, geometricMean(runs.map((run) => run[part][name]))]));
      return { point: null, variant, view: null, report: null, stages: named("stages"), parts: named("parts"),
        measures: data.measures.map((_, i) => geometricMean(runs.map((run) => infinite(run.measures[i])))),
        limited_by: [...new Set(runs.map((run) => run.limited_by))].join(", ") };
    });
  const isBaseline = (run) => run.variant === data.baseline;

  const digits = (value) => {
    if (value === 0) return "0";
    const magnitude = Math.abs(value);
    return magnitude >= 1e15 || magnitude < 1e-4 ? value.toExponential(2)
      : magnitude >= 1000 ? Math.round(value).toLocaleString("en").replaceAll(",", "\u202f")
      : String(Number(value.toPrecision(3)));
  };
  const written = (column, value) => {
    if (value === null || value === undefined) return "–";
    if (value === Infinity) return "∞";
    if (!isNumber(value)) return String(value);
    if (column.kind !== "measure") return exact(value);
    return column.unit === "share" ? `${(100 * value).toFixed(1)} %` : digits(value);
  };
  const heading = (column) => column.name + (column.unit && column.unit !== "share" ? `, ${column.unit}` : "")
    + (column.unit === "share" ? ", %" : "");

  // What is shown: the view and the filter.
  const choose = (select, options, wish) => {
    select.replaceChildren(...options.map((o) => new Option(o.label, o.value)));
    const known = options.find((o) => o.value === wish);
    select.value = known ? wish : options[0].value;
  };
  const option = (column) => ({ label: heading(column), value: column.name });
  const numericColumns = columns.filter((c) => c.numeric && c !== point);
  const ys = [...measureColumns, ...stageColumns, ...partColumns];
  const varied = [...axisColumns, ...keyColumns.filter((c) => !inAxis.has(c.keys[0]))]
    .filter((c) => new Set(data.runs.map(c.of)).size > 1);
  const area = columnOf.has("area_mm2") && measureColumns.includes(columnOf.get("area_mm2")) ? "area_mm2" : "design";
  const defaultColour = new Set(data.runs.map(design.of)).size > 1 ? "design" : (varied[1] ?? limit).name;
  choose(at("y"), ys.map(option), "latency_ms");
  choose(at("x"), [...axisColumns, ...numericColumns, ...keyColumns.filter((c) => !c.numeric), design].map(option),
    data.swept && varied.length > 0 ? varied[0].name : area);
  choose(at("colour"), [design, ...axisColumns, ...keyColumns, ...(areMorePes ? [pes] : []), view, limit].map(option), defaultColour);
  choose(at("view"), [...(data.views.length > 1 ? [{ label: `all ${data.views.length}`, value: "all" }] : []),
    ...(means.length > 0 ? [{ label: meanWords, value: "mean" }] : []),
    ...data.views.map((v, i) => ({ label: v.words, value: String(i) }))], "0");
  at("view-label").hidden = data.views.length < 2;

  /** One word of the filter: a text, or a column, a comparison and a value. */
  const test = (word) => {
    const match = /^(.+?)(<=|>=|!=|<|>|=)(.*)$/.exec(word);
    const column = match && columnOf.get(match[1]);
    if (!match || !column) {
      return match ? null : (run) => columns.some((c) =>
        !c.numeric && String(c.of(run)).toLowerCase().includes(word.toLowerCase()));
    }
    const value = match[3];
    const number = Number(value);
    return (run) => {
      const own = column.of(run);
      switch (match[2]) {
        case "=": return isNumber(own) ? own === number : String(own) === value;
        case "!=": return isNumber(own) ? own !== number : String(own) !== value;
        case "<": return isNumber(own) && own < number;
        case "<=": return isNumber(own) && own <= number;
        case ">": return isNumber(own) && own > number;
        default: return isNumber(own) && own >= number;
      }
    };
  };
  const shown = () => {
    const words = at("filter").value.trim().split(/\s+/).filter((w) => w !== "");
    const tests = words.map(test);
    const unknown = words.filter((_, i) => tests[i] === null);
    const which = at("view").value;
    const runs = (which === "mean" ? means : data.runs).filter((run) => (["all", "mean"].includes(which) || run.view === Number(which))
      && tests.every((t) => t === null || t(run)));
    at("filter-note").textContent = unknown.length > 0
      ? `There is no column for ${unknown.join(" ")}; the columns of the table can be named.`
      : words.length > 0 ? `${runs.length} points` : "";
    return runs;
  };

  const mostKeysInTip = 24; // more would not fit on a screen
  const tipOf = (run) => [
    run.point === null ? design.of(run) : `point ${run.point}, ${design.of(run)}`, ...keyColumns.slice(0, mostKeysInTip)
      .map((c) => `${c.name}: ${written(c, c.of(run))}`), ...(keyColumns.length > mostKeysInTip ? ["…"] : []),
    view.of(run), ...["latency_ms", "area_mm2"].map((n) => columnOf.get(n)).filter((c) => c)
      .map((c) => `${c.name}: ${written(c, c.of(run))}`), `limited_by: ${run.limited_by}`, ...(isOutside(run) ? [`breaks ${within.of(run)}`] : [])].join("\n");
  const widthOf = (element) => Math.max(240, Math.floor(element.clientWidth || 600));
  const isLogarithmic = (values) => {
    const numbers = values.filter((v) => isNumber(v) && Number.isFinite(v));
    return numbers.length > 1 && numbers.every((v) => v > 0) && d3.max(numbers) / d3.min(numbers) >= 7.9;
  };
  const ticks = (column) => (value) => (column.unit === "share" ? `${exact(100 * value)} %` : exact(value));
  /** Options of one axis: logarithmic where factors matter, with the values themselves as ticks if they are few. */
  const scaleOf = (column, runs) => {
    const values = [...new Set(runs.map(column.of).filter((v) => v !== null && v !== Infinity))];
    if (column.kind === "axis") {
      const first = column.keys.map((k) => keyColumns[k]).find((c) => c.numeric);
      const sorted = first ? d3.sort(runs, first.of) : runs;
      return { type: "point", label: heading(column), domain: [...new Set(sorted.map(column.of))] };
    }
    if (!column.numeric) return { type: "point", label: heading(column) };
    const few = column.kind === "key" && values.length <= 8;
    return { type: isLogarithmic(values) ? "log" : "linear", label: heading(column), nice: !few, grid: true,
      tickFormat: ticks(column), ...(few ? { ticks: values } : { ticks: 6 }) };
  };
  const openReport = (element) => element.addEventListener("click", () => {
    const run = element.value;
    if (run && run.report) window.open(run.report, "_blank");
  });
  const plot = (host, options) => {
    const figure = Plot.plot({ width: widthOf(host), style: { fontSize: "12px" }, ...options });
    host.replaceChildren(figure);
    openReport(figure);
  };
  const drawable = (x, y) => (run) => [x, y].every((c) => {
    const value = c.of(run);
    return value !== null && value !== Infinity && value !== undefined;
  });

  /** The runs in the order of the horizontal axis. */
  const inOrder = (x, runs) => {
    const first = x.kind === "axis" ? x.keys.map((k) => keyColumns[k]).find((c) => c.numeric) ?? x : x;
    return d3.sort(runs, first.of);
  };
  /** Lines join points that differ in the horizontal key, or the keys of the horizontal axis, alone. */
  const lineKey = (x) => (run) => JSON.stringify([run.view, design.of(run),
    ...keyColumns.filter((c) => !(x.keys ?? []).includes(c.keys[0])).map((c) => c.of(run))]);
  const lines = (runs, x, y, stroke) => {
    if (x.kind !== "key" && x.kind !== "axis") return [];
    const groups = d3.group(runs, lineKey(x));
    const joined = [...groups.values()].filter((g) => g.length > 1).flat();
    return [Plot.line(inOrder(x, joined), { x: x.of, y: y.of, z: lineKey(x), stroke, strokeOpacity: 0.6 })];
  };
  const drawMain = (runs) => {
    const x = columnOf.get(at("x").value);
    const y = columnOf.get(at("y").value);
    const colour = columnOf.get(at("colour").value);
    const good = runs.filter(drawable(x, y));
    const stroke = (run) => written(colour, colour.of(run));
    at("plot-title").textContent = `${y.name} over ${x.name}`;
    const several = new Set(good.map(view.of)).size > 1;
    plot(at("plot"), {
      height: Math.min(520, Math.max(320, widthOf(at("plot")) * 0.45)), marginLeft: 64, marginBottom: 44,
      x: { ...scaleOf(x, good), inset: 12 }, y: { ...scaleOf(y, good), inset: 8 },
      color: { ...colourScale(colour, good), legend: true, label: heading(colour) },
      ...(several ? { symbol: { legend: true, label: "view" } } : {}),
      marks: [...lines(good, x, y, stroke),
        Plot.dot(good.filter(isOutside), { x: x.of, y: y.of, stroke: "#999", strokeOpacity: 0.6, r: 3 }),
        Plot.dot(good.filter((run) => !isOutside(run)), { x: x.of, y: y.of, stroke, fill: stroke, r: 4,
          ...(several ? { symbol: view.of } : {}) }),
        Plot.dot(good.filter(isBaseline), { x: x.of, y: y.of, r: 9, stroke: "currentColor", strokeWidth: 1.5 }),
        Plot.tip(good, Plot.pointer({ x: x.of, y: y.of, title: tipOf, maxRadius: 30 }))],
    });
  };
  /** No two values have one colour: ten have names, and more of them are neighbours in a spectrum. */
  const colourScale = (colour, runs) => {
    const byNumbersInThem = new Intl.Collator("en", { numeric: true }).compare;
    const all = [...new Set(runs.map(colour.of))];
    const values = colour.numeric ? d3.sort(all, (v) => v) : all.sort((a, b) => byNumbersInThem(String(a), String(b)));
    const along = (interpolate, from, to) => ({
      range: values.map((_, i) => interpolate(from + (to - from) * i / (values.length - 1))) });
    return { domain: values.map((v) => written(colour, v)),
      ...(colour.numeric && values.length > 1 ? along(d3.interpolateViridis, 0.15, 0.85)
        : values.length > 10 ? along(d3.interpolateTurbo, 0.05, 0.95) : { scheme: "observable10" }) };
  };

  const drawKeys = (runs) => {
    const y = columnOf.get(at("y").value);
    const shownKeys = data.swept && varied.length > 1 ? varied : [];
    at("keys-section").hidden = shownKeys.length === 0;
    const base = data.variants[data.baseline].values;
    at("keys").replaceChildren(...shownKeys.map(() => document.createElement("figure")));
    shownKeys.forEach((x, i) => {
      const host = at("keys").children[i];
      const good = runs.filter(drawable(x, y));
      const others = good.filter((run) => data.variants[run.variant].values.every((value, k) =>
        x.keys.includes(k) || value === base[k]));
      plot(host, {
        height: 240, marginLeft: 64, marginBottom: 64,
        x: { ...scaleOf(x, good), inset: 8, tickRotate: -25, labelOffset: 56 },
        y: { ...scaleOf(y, good), inset: 6, ticks: 5 },
        marks: [Plot.dot(good, { x: x.of, y: y.of, r: 2.5, fill: "currentColor", fillOpacity: 0.25 }),
          Plot.line(inOrder(x, others), { x: x.of, y: y.of, z: (run) => `${run.view} ${design.of(run)}`,
            stroke: view.of, strokeWidth: 2, marker: "circle" }),
          Plot.dot(others.filter(isBaseline), { x: x.of, y: y.of, r: 7, stroke: "currentColor" }),
          Plot.tip(good, Plot.pointer({ x: x.of, y: y.of, title: tipOf, maxRadius: 30 }))],
      });
    });
  };

  /** One of the parallel axes, with room for a value that all designs share; the best value is at its top. */
  const goalAxis = (goal, values, bottom, top) => {
    const [least, most] = d3.extent(values);
    const room = least === most ? Math.abs(least) * 0.05 || 1 : 0;
    const ends = [least - room, most + room];
    return (isLogarithmic(values) ? d3.scaleLog() : d3.scaleLinear())
      .domain(goal.larger ? ends : ends.reverse()).range([bottom, top]);
  };
  /** Parallel axes (A. Inselberg, The Plane with Parallel Coordinates, 1985), for three goals and more. */
  const drawGoals = (runs) => {
    const wanted = new Map(runs.map((run) => [run.variant, run]));
    const lines = data.variants.map((v, i) => ({ ...v, run: wanted.get(i), baseline: i === data.baseline }))
      .filter((v) => v.run && v.goals.length > 2 && v.goals.every(isNumber));
    at("goals-section").hidden = lines.length === 0;
    if (lines.length === 0) return;
    const side = 90, top = 56, height = 380, bottom = height - 14;
    const width = Math.max(widthOf(at("goals")), 2 * side + 150 * (data.goals.length - 1));
    const x = d3.scalePoint(data.goals.map((_, g) => g), [side, width - side]);
    const axes = data.goals.map((goal, g) => goalAxis(goal, lines.map((v) => v.goals[g]), bottom, top));
    const svg = d3.create("svg").attr("width", width).attr("height", height).attr("role", "img")
      .attr("aria-label", `Goals of ${lines.length} designs: ${data.goals.map((g) => g.name).join(", ")}`);
    const breaks = (v) => data.limited && !["yes", ""].includes(v.within);
    at("dashed").hidden = !data.limited;
    const kind = (v) => (v.baseline ? 3 : v.front ? 2 : breaks(v) ? 0 : 1); // later lines lie above others
    svg.append("g").selectAll("path").data(d3.sort(lines, kind)).join("path")
      .attr("class", (v) => ["design", ...(v.front ? ["front"] : []), ...(breaks(v) ? ["outside"] : []),
        ...(v.baseline ? ["baseline"] : [])].join(" "))
      .attr("d", (v) => d3.line()(v.goals.map((value, g) => [x(g), axes[g](value)])))
      .on("click", (_, v) => { if (v.run.report) window.open(v.run.report, "_blank"); })
      .append("title").text((v) => [v.name, ...data.goals.map((goal, g) => `${goal.name}: ${digits(v.goals[g])}`),
        v.baseline ? "the baseline" : "", v.front ? "on the front" : "", breaks(v) ? `breaks ${v.within}` : ""]
        .filter((words) => words !== "").join("\n"));
    data.goals.forEach((goal, g) => {
      const axis = svg.append("g").attr("transform", `translate(${x(g)},0)`)
        .call(d3.axisLeft(axes[g]).ticks(6).tickFormat(digits));
      axis.selectAll("text").attr("paint-order", "stroke").attr("stroke", "var(--back)").attr("stroke-width", 4);
      // Neighbours have their names at two heights, so that long ones do not touch.
      const name = axis.append("text").attr("class", "name").attr("x", 0).attr("y", g % 2 === 0 ? 14 : 32)
        .attr("text-anchor", g === 0 ? "start" : g + 1 === data.goals.length ? "end" : "middle")
        .attr("dx", g === 0 ? -side + 4 : g + 1 === data.goals.length ? side - 4 : 0);
      const most = Math.floor(1.7 * x.step() / 7);
      name.text(goal.name.length > most ? `${goal.name.slice(0, most - 1)}…` : goal.name);
      name.append("title").text(`${goal.name} (${goal.larger ? "larger" : "smaller"} is better)`);
    });
    at("goals").replaceChildren(svg.node());
  };

  // The colours of the classes are those of slots.svg.
  const slotColumns = data.slots.map((slot) => ({ ...slot, column: columnOf.get(`slots.${slot.name}`) }))
    .filter((slot) => slot.column);
  const mostBars = 40;
  const drawSlots = (runs) => {
    // Geometric means of shares do not add up to 1, so bars are of single views.
    const good = runs.filter((run) => run.view !== null && slotColumns.some((s) => s.column.of(run) !== null));
    at("slots-section").hidden = good.length === 0;
    if (good.length === 0) return;
    const bars = good.slice(0, mostBars);
    at("slots-note").textContent = good.length > mostBars
      ? `The first ${mostBars} of ${good.length} points; the filter chooses others.` : "";
    const narrow = widthOf(at("slots")) < 700;
    const label = (run) => (narrow ? `${run.point}` : `${run.point} ${data.variants[run.variant].name}`);
    const short = (run) => (label(run).length > 62 ? `${label(run).slice(0, 60)}…` : label(run));
    const cells = bars.flatMap((run) => slotColumns.map((s) => ({ run, slot: s.name, share: s.column.of(run) ?? 0 })));
    const longest = d3.max(bars, (run) => short(run).length);
    plot(at("slots"), {
      height: 76 + 22 * bars.length, marginBottom: 46, marginLeft: 16 + 6.3 * longest, marginRight: 20,
      x: { label: "share of the PE-cycles", tickFormat: (v) => `${Math.round(100 * v)} %`, domain: [0, 1], grid: true },
      y: { label: null, domain: bars.map((run) => run.point),
        tickFormat: (p) => short(bars.find((run) => run.point === p)) },
      color: { domain: slotColumns.map((s) => s.name), range: slotColumns.map((s) => s.colour), legend: true },
      marks: [Plot.barX(cells, Plot.stackX({ y: (c) => c.run.point, x: "share", fill: "slot", order: null, insetTop: 1,
        insetBottom: 1 })),
      Plot.tip(cells, Plot.pointerY(Plot.stackX({ y: (c) => c.run.point, x: "share", order: null,
        title: (c) => `${slotColumns.map((s) => `${s.name}: ${written(s.column, s.column.of(c.run))}`).join("\n")}\n${
          tipOf(c.run)}` })))],
    });
  };

  // The table.
  const few = new Set(["cycles", "latency_ms", "fps", "throughput_fps", "slots.utilization", "dram.bytes_read",
    "dram.bytes_written", "dram.utilization", "area_mm2", "ratio.latency", "ratio.latency_per_mm2", "image.psnr_db",
    "energy.nj_per_frame", "ratio.energy"]);
  let order = { column: point, down: false };
  const tableColumns = () => columns.filter((c) => (c.kind !== "measure" && (data.swept || c.kind !== "key")) || at("all-columns").checked || few.has(c.name))
    .filter((c) => c !== view || data.views.length > 1);
  const compare = (a, b) => (a === null ? 1 : b === null ? -1 : d3.ascending(a, b));
  const cellOf = (column, run) => {
    const cell = document.createElement("td");
    cell.className = column.numeric ? "" : "text";
    if (column === point && run.report) {
      const link = document.createElement("a");
      link.href = run.report;
      link.textContent = run.point;
      cell.append(link);
    } else {
      cell.textContent = written(column, column.of(run));
      if (isNumber(column.of(run))) cell.title = String(column.of(run));
    }
    return cell;
  };
  const headOf = (column) => {
    const cell = document.createElement("th");
    cell.scope = "col";
    cell.className = column.numeric ? "" : "text";
    cell.title = column.sentence;
    cell.ariaSort = order.column !== column ? "none" : order.down ? "descending" : "ascending";
    const button = document.createElement("button");
    button.type = "button";
    // On paper long names may break, but only behind their dots and underscores.
    column.name.split(/(?<=[._])/).forEach((part) => button.append(part, document.createElement("wbr")));
    button.append(order.column !== column ? "" : order.down ? " ▾" : " ▴");
    button.addEventListener("click", () => {
      order = { column, down: order.column === column && !order.down };
      drawTable(shown());
    });
    cell.append(button);
    if (column.unit) {
      const unit = document.createElement("small");
      unit.textContent = column.unit;
      cell.append(unit);
    }
    return cell;
  };
  const drawTable = (runs) => {
    const list = tableColumns();
    const head = document.createElement("tr");
    head.append(...list.map(headOf));
    at("table").tHead.replaceChildren(head);
    const sorted = [...runs].sort((a, b) => {
      const by = compare(order.column.of(a), order.column.of(b));
      return (order.down && order.column.of(a) !== null && order.column.of(b) !== null ? -by : by) || a.point - b.point;
    });
    at("table").tBodies[0].replaceChildren(...sorted.map((run) => {
      const row = document.createElement("tr");
      row.className = `${isBaseline(run) ? "baseline" : ""} ${isOutside(run) ? "outside" : ""}`.trim();
      row.title = (isBaseline(run) ? "the baseline" : data.variants[run.variant].name)
        + (isOutside(run) ? `, which breaks ${within.of(run)}` : "");
      row.append(...list.map((column) => cellOf(column, run)));
      return row;
    }));
  };

  // What is shown, as files.
  const save = (name, type, text) => {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([text], { type }));
    link.download = name;
    link.click();
    URL.revokeObjectURL(link.href);
  };
  /** The chart of `host` with the colours of its legend below it, black on white. */
  const svgOf = (host) => {
    const chart = [...host.querySelectorAll("svg")].filter((svg) => !svg.closest(".plot-swatch, [class*=swatches]")).pop();
    const copy = d3.select(chart.cloneNode(true)).attr("xmlns", "http://www.w3.org/2000/svg")
      .style("color", "black").style("background", "white");
    const [width, height] = [Number(chart.getAttribute("width")), Number(chart.getAttribute("height"))];
    let [x, y] = [8, height + 14];
    host.querySelectorAll("[class*=swatches] > span, .plot-swatch").forEach((swatch) => {
      const words = swatch.textContent;
      const room = 28 + 7 * words.length;
      if (x + room > width) [x, y] = [8, y + 20];
      const mark = swatch.querySelector("svg")?.cloneNode(true);
      if (mark) copy.append(() => mark).attr("x", x).attr("y", y - 11).attr("width", 14).attr("height", 14);
      copy.append("text").attr("x", x + 18).attr("y", y).attr("font-size", 12).attr("text-anchor", "start").text(words);
      x += room;
    });
    copy.attr("height", y + 12).attr("viewBox", `0 0 ${width} ${y + 12}`);
    copy.insert("desc", ":first-child").text(`${document.title}; filter: ${at("filter").value}`);
    return new XMLSerializer().serializeToString(copy.node());
  };
  const csvCell = (value) => (/[",\n]/.test(value) ? `"${value.replaceAll('"', '""')}"` : value);
  const csvOf = (runs) => {
    const list = tableColumns();
    const head = list.map((c) => csvCell(c.unit ? `${c.name}, ${c.unit}` : c.name));
    return [head, ...runs.map((run) => list.map((c) => csvCell(String(c.of(run) ?? ""))))]
      .map((row) => row.join(",") + "\n").join("");
  };
  document.querySelectorAll("[data-svg]").forEach((button) => button.addEventListener("click", () =>
    save(`${button.dataset.svg}.svg`, "image/svg+xml", svgOf(at(button.dataset.svg)))));
  at("save-csv").addEventListener("click", () => save("points.csv", "text/csv", csvOf(shown())));

  const drawLeftOut = () => {
    const part = (title, entries) => {
      if (entries.length === 0) return [];
      const head = document.createElement("h2");
      head.textContent = title;
      const list = document.createElement("ul");
      list.append(...entries.map((entry) => {
        const item = document.createElement("li");
        item.textContent = `${entry.name}: ${entry.why}`;
        return item;
      }));
      return [head, list];
    };
    at("left-out").replaceChildren(...part("Points that cannot be built", data.skipped),
      ...part("Runs that failed", data.failed));
  };

  const draw = () => {
    const runs = shown();
    drawMain(runs);
    drawGoals(runs);
    drawKeys(runs);
    drawSlots(runs);
    drawTable(runs);
  };
  const count = (n, one, many) => `${n} ${n === 1 ? one : many}`;
  at("summary").textContent = [count(data.runs.length, "run", "runs"), count(data.variants.length, "configuration", "configurations"),
    count(data.views.length, "view", "views"), data.array_only ? "arrays alone, without front ends and memory" : "",
    data.estimated ? "estimates of the analytic model, not simulations" : "",
    data.spent, data.missing ? `${data.missing} points missing` : "", `ratios compare with ${data.variants[data.baseline].name}`]
    .filter((words) => words !== "").join(" · ");
  at("footer").textContent = `degs ${data.version}`;
  for (const id of ["x", "y", "colour", "view"]) at(id).addEventListener("change", draw);
  at("filter").addEventListener("input", draw);
  at("all-columns").addEventListener("change", () => drawTable(shown()));
  at("controls").addEventListener("submit", (event) => event.preventDefault());
  let width = 0;
  const fit = () => {
    if (at("plot").clientWidth !== width) {
      width = at("plot").clientWidth;
      draw();
    }
  };
  fit();
  new ResizeObserver(() => requestAnimationFrame(fit)).observe(at("plot"));
  drawLeftOut();
})();
