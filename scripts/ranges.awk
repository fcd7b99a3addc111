# SPDX-License-Identifier: Apache-2.0
# ranges.awk: Markdown tables of scripts/ranges.sh. Input lines: `reading | name | file | class | settings` and
# `run | view | reading | camera | ms | mm2 | utilization`. Variables: table (which one), cameras (those that were run),
# csv (1: the tables of single readings as CSV).
$1 == "reading" {
    order[++readings] = $2; file[$2] = $3; class[$2] = $4; settings[$2] = $5
    split($2, part, "-"); design[$2] = part[1]
    if ($4 == "shipped") shipped[$3] = $2
}
$1 == "run" {
    if (!($2 in seen)) { seen[$2] = 1; views[++view_count] = $2 }
    ms[$2, $3] = $5; area[$3] = $6
    n[$4, $3]++; time[$4, $3] += log($5); useful[$4, $3] += log($7)
}
# A reading says what the design of Table I is, so it keeps the area of its file as shipped.
function area_of(name) {
    return (file[name] in shipped) && (shipped[file[name]] in area) ? area[shipped[file[name]]] : area[name]
}
# Geometric means over the views of a camera; speed-ups per area are of DeGS.
function utilization(camera, name) {
    return ((camera, name) in n) ? sprintf("%.1f", 100 * exp(useful[camera, name] / n[camera, name])) : "-"
}
function ratio(camera, degs, other) {
    if (!((camera, degs) in n) || !((camera, other) in n)) return 0
    return exp(time[camera, other] / n[camera, other] - time[camera, degs] / n[camera, degs]) * area_of(other) / area_of(degs)
}
function cell(value) { return value ? sprintf("%.2f", value) : "" }
# A line of a table, or of a CSV; no cell has a comma.
function line_of_table(line) {
    if (csv) { gsub(/^\| | \|$/, "", line); gsub(/ \| /, ",", line) }
    print line
}
function keys(name, text) { text = settings[name]; gsub(/ /, "`, `", text); return "`" text "`" }
# Long lists of keys stand below the table, under the name of the reading.
function what(name) {
    if (settings[name] == "") return "as shipped"
    if (csv) return settings[name]
    if (length(settings[name]) < 75) return keys(name)
    if (!(name in long)) { long[name] = 1; legend[++legends] = name }
    return "*" name "*"
}
function print_legend(i) {
    for (i = 1; i <= legends; ++i) print (i == 1 ? "\n" : "") "* *" legend[i] "*: " keys(legend[i])
}
# A table's head; `left` are the numbers of the columns of text.
function head(columns, left, text, i) {
    line_of_table(text); line = "|"
    if (csv) return
    for (i = 1; i <= columns; ++i) line = line (index(" " left " ", " " i " ") ? "---|" : "--:|")
    print line
}
# One row per reading with the utilization on each camera.
function utilization_table(i, c, name) {
    line = "| design | what is set | text |"
    for (c = 1; c <= cams; ++c) line = line " camera " camera[c] " |"
    head(3 + cams, "1 2 3", line)
    for (i = 1; i <= readings; ++i) {
        name = order[i]
        line = "| " file[name] " | " what(name) " | " class[name] " |"
        for (c = 1; c <= cams; ++c) line = line " " utilization(camera[c], name) " |"
        line_of_table(line)
    }
}
# The least and the most of what the text leaves open, for every file.
function utilization_range(i, c, j, name, value) {
    head(6, "1 6", "| design | camera | least | shipped | most | keys of the least / of the most |")
    for (i = 1; i <= readings; ++i) {
        if (class[order[i]] != "shipped") continue
        for (c = 1; c <= cams; ++c) {
            least = 101; most = 0
            for (j = 1; j <= readings; ++j) {
                name = order[j]; value = utilization(camera[c], name)
                if (file[name] != file[order[i]] || class[name] == "against" || value == "-") continue
                if (value + 0 < least) { least = value + 0; low = name }
                if (value + 0 > most) { most = value + 0; high = name }
            }
            if (least > 100) continue # this camera was not run
            printf "| %s | %s | %.1f | %s | %.1f | %s / %s |\n", file[order[i]], camera[c], least,
                utilization(camera[c], order[i]), most, what(low), what(high)
        }
    }
}
# Pairs that one reading of the text may set side by side: both open, or both with the squares of all designs.
function together(a, b) {
    if (class[a] == "squares" || class[b] == "squares") return class[a] == class[b]
    return (class[a] == "open" || class[a] == "shipped") && (class[b] == "open" || class[b] == "shipped")
}
function pair(a, b, text) {
    text = settings[a] == "" ? "" : "DeGS: " what(a)
    if (settings[b] != "") text = text (text == "" ? "" : "; ") "baseline: " what(b)
    return text == "" ? "as shipped" : text
}
function range_table(c, i, j, k, value, name) {
    head(6, "1 6", "| over | camera | least | shipped | most | keys of the least / of the most |")
    for (k = 2; k <= 4; ++k)
        for (c = 1; c <= cams; ++c) {
            least = 0; most = 0
            for (i = 1; i <= readings; ++i)
                for (j = 1; j <= readings; ++j) {
                    if (design[order[i]] != "degs" || design[order[j]] != names[k]) continue
                    if (!together(order[i], order[j])) continue
                    value = ratio(camera[c], order[i], order[j])
                    if (value && (!least || value < least)) { least = value; low = order[i]; low2 = order[j] }
                    if (value > most) { most = value; high = order[i]; high2 = order[j] }
                }
            if (!most) continue # this camera was not run
            printf "| %s | %s | %s | %s | %s | %s / %s |\n", title[k], camera[c], cell(least),
                cell(ratio(camera[c], "degs", names[k])), cell(most), pair(low, low2), pair(high, high2)
        }
}
# Each change alone: one of DeGS against the shipped baselines, one of a baseline against the shipped DeGS; `squares`
# and `slow` are of all designs.
function speed_table(i, c, k, name, base, other) {
    line = "| design | what is set | text |"
    for (k = 2; k <= 4; ++k) for (c = 1; c <= cams; ++c) line = line " " title[k] (csv ? "" : ",") " camera " camera[c] " |"
    head(3 + 3 * cams, "1 2 3", line)
    for (i = 1; i <= readings; ++i) {
        name = order[i]
        all = class[name] == "squares" || class[name] == "slow"
        if (design[name] != "degs" && (class[name] == "shipped" || name == design[name] "-" class[name])) continue
        base = design[name] == "degs" ? name : all ? "degs-" class[name] : "degs"
        line = "| " (all && name == "degs-" class[name] ? "all" : file[name]) " | " what(name) " | " class[name] " |"
        for (k = 2; k <= 4; ++k)
            for (c = 1; c <= cams; ++c) {
                other = design[name] == "degs" ? names[k] (all ? "-" class[name] : "") : design[name] == names[k] ? name : ""
                line = line " " (other == "" ? "" : cell(ratio(camera[c], base, other))) " |"
            }
        line_of_table(line)
    }
}
function frames_table(v, k) {
    head(5, "1", "| view | DeGS-64, ms | GSCore | GBU | GCC |")
    for (v = 1; v <= view_count; ++v) {
        line = "| " substr(views[v], 8) " | " sprintf("%.3f", ms[views[v], "degs"]) " |"
        for (k = 2; k <= 4; ++k)
            line = line " " cell(ms[views[v], names[k]] / ms[views[v], "degs"] * area[names[k]] / area["degs"]) " |"
        print line
    }
}
END {
    cams = split(cameras, camera, " ")
    split("degs gscore gbu gcc", names, " "); split("DeGS GSCore GBU GCC", title, " ")
    if (table == "range") range_table()
    else if (table == "speed") speed_table()
    else if (table == "frames") frames_table()
    else if (table == "least-most") utilization_range()
    else utilization_table()
    print_legend()
    if (!csv) print ""
}
