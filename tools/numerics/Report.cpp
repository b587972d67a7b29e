// SPDX-License-Identifier: Apache-2.0
#include "tools/numerics/Report.h"

#include "toolkit/json/JsonFile.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace filament_core::shader::numerics {
namespace {

constexpr std::array<std::string_view, kOutsideInputs> kOutsideNames{ "beyond", "huge", "infinite", "nan" };

std::string errorText(double error) { return error == 0 ? "0" : fmt::format("{:.1e}", error); }

std::string cellOf(RowResult const& row, Column column) {
    if (!isMeasured(*row.row, column)) return "fp32 only";
    if (!row.of(column)) return "no device";
    if (!row.row->noError.empty()) return "finite";
    return errorText(row.of(column)->worst);
}

std::vector<std::string> allViolations(Study const& study, RowResult const& row) {
    std::vector<std::string> all;
    for (const Column column : kColumns) {
        if (!row.of(column)) continue;
        for (std::string& one : violations(*row.row, column, *row.of(column))) all.push_back(std::move(one));
    }
    if (study.promisesSameBits && row.differing[0] > 0)
        all.push_back(fmt::format("{} results differ between Vulkan and OpenGL ES in 32 bits", row.differing[0]));
    return all;
}

std::string csvField(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
    return result + "\"";
}

void appendCsvLine(std::string& csv, RowResult const& row, Column column) {
    Measurement const& m = *row.of(column);
    const auto at = [&](std::optional<Point> const& point) {
        return csvField(point ? describe(*row.row, *point) : std::string());
    };
    csv += fmt::format("{},{},{},{},{},", row.row->file, csvField(row.row->function), csvField(row.row->part),
                       toString(column), m.inputs);
    csv += fmt::format("{:.3g},{:.3g},{:.3g},{},{},{},{},{},{}", m.worst, m.percentile99, limitOf(*row.row, column),
                       at(m.worstAt), m.nan, m.infinite, m.outOfRange, m.notMonotone, at(m.firstNotFinite));
    for (OutsideCount const& count : m.outside)
        csv += fmt::format(",{},{},{}", count.number, count.infinite, count.nan);
    csv += fmt::format(",{}\n", at(m.firstOutsideNotFinite));
}

tools::Json jsonOf(Row const& row, Column column, Measurement const& m) {
    tools::Json json{ { "inputs", m.inputs },
                      { "maxError", m.worst },
                      { "p99Error", m.percentile99 },
                      { "limit", limitOf(row, column) },
                      { "nan", m.nan },
                      { "infinite", m.infinite },
                      { "outOfRange", m.outOfRange },
                      { "notMonotone", m.notMonotone } };
    if (m.worstAt) json["maxErrorAt"] = describe(row, *m.worstAt);
    if (m.firstNotFinite) json["firstNotFinite"] = describe(row, *m.firstNotFinite);
    if (m.firstOutsideNotFinite) json["firstOutsideNotFinite"] = describe(row, *m.firstOutsideNotFinite);
    for (size_t i = 0; i < kOutsideInputs; ++i) {
        OutsideCount const& count = m.outside[i];
        json["outside"][std::string(kOutsideNames[i])] = { { "number", count.number },
                                                           { "infinite", count.infinite },
                                                           { "nan", count.nan } };
    }
    return json;
}

} // namespace

std::string titleOf(Row const& row) {
    return row.part.empty() ? std::string(row.function) : fmt::format("{}, {}", row.function, row.part);
}

size_t violationCount(Study const& study) {
    size_t count = 0;
    for (RowResult const& row : study.rows) count += allViolations(study, row).size();
    return count;
}

std::string terminalTable(Study const& study) {
    size_t width = 0;
    for (RowResult const& row : study.rows) width = std::max(width, titleOf(*row.row).size());
    std::string text = fmt::format("{:{}}", "largest relative error", width);
    for (const Column column : kColumns) text += fmt::format(" {:>12}", toString(column));
    text += '\n';
    for (RowResult const& row : study.rows) {
        text += fmt::format("{:{}}", titleOf(*row.row), width);
        for (const Column column : kColumns) text += fmt::format(" {:>12}", cellOf(row, column));
        text += '\n';
        for (std::string const& one : allViolations(study, row)) text += "  ! " + one + '\n';
    }
    for (std::string const& reason : study.missing) text += "no device: " + reason + '\n';
    return text;
}

std::string csvOf(Study const& study) {
    std::string csv = "file,function,part,column,inputs,max_error,p99_error,limit,max_error_at,nan,inf,out_of_range,"
                      "not_monotone,first_not_finite";
    for (const std::string_view name : kOutsideNames) csv += fmt::format(",{0}_number,{0}_inf,{0}_nan", name);
    csv += ",first_outside_not_finite\n";
    for (RowResult const& row : study.rows) {
        for (const Column column : kColumns) {
            if (row.of(column)) appendCsvLine(csv, row, column);
        }
    }
    return csv;
}

std::string jsonOf(Study const& study) {
    tools::Json json{ { "vulkan", study.devices[0] }, { "gles", study.devices[1] } };
    json["rows"] = tools::Json::array();
    for (RowResult const& row : study.rows) {
        tools::Json one{ { "file", row.row->file },
                         { "function", row.row->function },
                         { "part", row.row->part },
                         { "why", row.row->limits.why },
                         { "fp32Only", row.row->fp32Only },
                         { "differingInFp32", row.differing[0] },
                         { "differingInFp16", row.differing[1] } };
        for (const Column column : kColumns) {
            if (row.of(column))
                one["columns"][std::string(toString(column))] = jsonOf(*row.row, column, *row.of(column));
        }
        json["rows"].push_back(std::move(one));
    }
    return tools::jsonText(json);
}

} // namespace filament_core::shader::numerics
