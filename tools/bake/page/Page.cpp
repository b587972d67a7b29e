// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/page/Page.h"

#include "filament_core/assets/files/FileBytes.h"
#include "toolkit/program/Html.h"

#include <fmt/format.h>

#include <span>

namespace filament_core::bake {
namespace {

using tools::escapedHtml;

constexpr const char* kStyle = R"(<style>
body{font:15px/1.5 system-ui,sans-serif;margin:2rem auto;max-width:96rem;padding:0 1rem;color:#222;background:#fff}
table{border-collapse:collapse;font-variant-numeric:tabular-nums}td,th{padding:.1rem .7rem;text-align:right;border-bottom:1px solid #ddd}
td:first-child,th:first-child{text-align:left}.rows{max-height:32rem;overflow:auto;display:inline-block}
th{position:sticky;top:0;background:#fff}figure{display:inline-block;margin:.3rem;vertical-align:top}
figcaption{font-size:13px;color:#555}.map{width:384px;image-rendering:pixelated;background:#000}</style>
)";

/// By way of a file beside the page, which is what the writer of images makes.
Result<std::string> figureOf(PagePicture const& picture, std::filesystem::path const& path) {
    const std::filesystem::path file = path.string() + ".png";
    if (const Result<void> saved = savePng(file, picture.image); !saved) return saved.error();
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(file);
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    if (!bytes) return bytes.error();
    return tools::figureOfPng(*bytes, picture.title, picture.isMap ? "map" : "view");
}

std::string rowOf(std::vector<std::string> const& cells, const char* tag) {
    std::string html = "<tr>";
    for (std::string const& cell : cells) html += fmt::format("<{0}>{1}</{0}>", tag, escapedHtml(cell));
    return html + "</tr>\n";
}

std::string tableOf(PageTable const& table) {
    std::string html = fmt::format("<h3>{}</h3><div class=\"rows\"><table>\n", escapedHtml(table.title));
    html += rowOf(table.columns, "th");
    for (auto const& row : table.rows) html += rowOf(row, "td");
    return html + "</table></div>\n";
}

Result<std::string> sectionOf(PageSection const& section, std::filesystem::path const& path) {
    std::string html = fmt::format("<h2>{}</h2>\n", escapedHtml(section.title));
    for (std::string const& sentence : section.sentences) html += "<p>" + escapedHtml(sentence) + "</p>\n";
    for (PagePicture const& picture : section.pictures) {
        const Result<std::string> figure = figureOf(picture, path);
        if (!figure) return figure;
        html += *figure + "\n";
    }
    for (PageTable const& table : section.tables) html += tableOf(table);
    return html;
}

} // namespace

Result<void> writePage(std::filesystem::path const& path, Page const& page) {
    const std::string title = escapedHtml(page.title);
    std::string html = fmt::format("<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}</title>{}"
                                   "</head><body>\n<h1>{}</h1>\n",
                                   title, kStyle, title);
    for (PageSection const& section : page.sections) {
        const Result<std::string> part = sectionOf(section, path);
        if (!part) return part.error();
        html += *part;
    }
    html += "</body></html>\n";
    return assets::replaceFile(path, std::as_bytes(std::span(html)));
}

} // namespace filament_core::bake
