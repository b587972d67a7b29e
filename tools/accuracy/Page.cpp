// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/Page.h"

#include "filament_core/assets/files/FileBytes.h"
#include "toolkit/json/JsonFile.h"
#include "toolkit/paths/Paths.h"
#include "toolkit/program/Console.h"
#include "tools/accuracy/PagePictures.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <span>

namespace filament_core::accuracy {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFragment = ".fragment.html";

Result<void> writeText(fs::path const& path, std::string const& text) {
    return assets::replaceFile(path, std::as_bytes(std::span(text)));
}

/// tools/plot/plot.py; starting it takes longer than drawing, so each call draws everything of its kind.
bool runPlot(std::string_view command, fs::path const& input, fs::path const& output) {
    const std::string line = fmt::format("'{}' '{}/tools/plot/plot.py' {} '{}' -o '{}'", tools::plotPython().string(),
                                         tools::sourceDir().string(), command, input.string(), output.string());
    return std::system(line.c_str()) == 0;
}

/// Further sections, in the order in which the page shows them.
std::vector<fs::path> fragmentsOf(ReportPlaces const& places) {
    std::vector<fs::path> files = places.include;
    std::error_code error;
    for (auto const& entry : fs::directory_iterator(places.out, error))
        if (entry.path().string().ends_with(kFragment)) files.push_back(entry.path());
    std::sort(files.begin() + static_cast<std::ptrdiff_t>(places.include.size()), files.end());
    return files;
}

/// A fragment in the folder of the page, beside its images. Nothing: it cannot be read, which is a warning.
Result<void> adopt(fs::path const& file, fs::path const& to, PagePictures& pictures) {
    const auto bytes = assets::readFileBytes(file);
    if (!bytes) {
        tools::printWarning(bytes.error().message);
        return {};
    }
    const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    Result<std::string> section = pictures.adopt(text, file.parent_path());
    if (!section) return section.error();
    const std::string folder = fmt::format("src=\"{}/", to.parent_path().filename().string());
    for (size_t at = section->find(folder); at != std::string::npos; at = section->find(folder, at))
        section->replace(at, folder.size(), "src=\"");
    return writeText(to, *section);
}

Result<void> adoptFragments(ReportPlaces const& places, fs::path const& folder, PagePictures& pictures) {
    std::set<fs::path> kept;
    for (fs::path const& file : fragmentsOf(places)) {
        const fs::path to = folder / fmt::format("{:02}-{}", kept.size(), file.filename().string());
        if (const Result<void> done = adopt(file, to, pictures); !done) return done;
        kept.insert(to);
    }
    std::error_code error;
    for (auto const& entry : fs::directory_iterator(folder, error)) // of an earlier report
        if (entry.path().string().ends_with(kFragment) && !kept.contains(entry.path())) fs::remove(entry.path(), error);
    return {};
}

} // namespace

Result<void> writeReport(Results const& results, ReportPlaces const& places) {
    return writeReport(jsonOf(results), places);
}

Result<void> writeReport(tools::Json const& data, ReportPlaces const& places) {
    const std::string json = tools::jsonText(data);
    if (auto done = writeText(places.out / "results.json", json); !done) return done;
    if (auto done = writeText(places.out / "results.csv", csvOf(data)); !done) return done;
    if (places.plots && !runPlot("accuracy", places.out / "results.json", places.out / "plots"))
        tools::printWarning("no plots: tools/plot/plot.py failed");

    const fs::path folder = places.page.parent_path() / places.page.stem();
    PagePictures pictures(places.page);
    if (auto done = writeText(folder / "results.json", json); !done) return done;
    if (auto done = adoptFragments(places, folder, pictures); !done) return done;
    pictures.removeOthers();
    if (runPlot("accuracy-page", folder, places.page)) return {};
    return fail(ErrorCode::Unreadable, "{}: tools/plot/plot.py accuracy-page failed, see above", places.page.string());
}

} // namespace filament_core::accuracy
