// SPDX-License-Identifier: Apache-2.0
#include "tools/accuracy/interiors/InteriorPage.h"

#include "filament_core/assets/files/FileBytes.h"
#include "tools/accuracy/comparison/Difference.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>

namespace filament_core::accuracy {
namespace {

std::string percent(double value) { return fmt::format("{:.1f} %", value * 100); }

Json jsonOf(InteriorResult const& interior) {
    Json techniques = Json::object();
    for (size_t t = 0; t < kLightTechniques; ++t) {
        TechniqueResult const& one = interior.techniques[t];
        Json ratios = Json::object();
        for (auto const& [backend, ratio] : one.ratios)
            ratios[backend] = { { "median", ratio.median }, { "low", ratio.low }, { "high", ratio.high } };
        const auto technique = static_cast<LightTechnique>(t);
        techniques[toString(technique)] = { { "error", interior.error(technique) },
                                            { "cameras", one.errors },
                                            { "timeRatio", ratios } };
    }
    return { { "name", interior.name },         { "best", toString(interior.best()) }, { "gain", interior.gain() },
             { "noise", interior.meanNoise() }, { "cameraNoise", interior.noise },     { "techniques", techniques } };
}

/// Pictures of one size beside each other, row by row.
Image sheetOf(std::vector<std::vector<Picture const*>> const& rows) {
    const uint32_t width = rows[0][0]->width, height = rows[0][0]->height, gap = 4;
    Image sheet{ .width = static_cast<uint32_t>(rows[0].size()) * (width + gap) - gap,
                 .height = static_cast<uint32_t>(rows.size()) * (height + gap) - gap,
                 .format = Format::RGBA8 };
    sheet.pixels.resize(size_t(sheet.width) * sheet.height * 4, std::byte{ 255 });
    for (size_t row = 0; row < rows.size(); ++row) {
        for (size_t column = 0; column < rows[row].size(); ++column) {
            const Image shown = tonemapped(*rows[row][column]);
            for (uint32_t y = 0; y < height; ++y) {
                const size_t at = ((row * (height + gap) + y) * sheet.width + column * (width + gap)) * 4;
                std::memcpy(&sheet.pixels[at], &shown.pixels[size_t(y) * width * 4], size_t(width) * 4);
            }
        }
    }
    return sheet;
}

std::vector<Picture const*> rowOf(InteriorResult const& interior, size_t camera) {
    std::vector<Picture const*> row;
    for (TechniqueResult const& technique : interior.techniques) row.push_back(&technique.pictures[camera]);
    row.push_back(&interior.traced[camera]);
    return row;
}

std::string timesOf(TechniqueResult const& technique) {
    std::string text;
    for (auto const& [backend, ratio] : technique.ratios)
        text += fmt::format("{}{:.2f}", text.empty() ? "" : " / ", ratio.median);
    return text;
}

std::string tableOf(InteriorResult const& interior) {
    const size_t cameras = interior.noise.size();
    std::string text = fmt::format("| {} |", interior.title), rule = "|---|";
    for (size_t i = 0; i < cameras; ++i) text += fmt::format(" camera {} |", i + 1), rule += "---|";
    text += " all | nearer | time |\n" + rule + "---|---|---|\n";
    for (size_t t = 0; t < kLightTechniques; ++t) {
        const auto technique = static_cast<LightTechnique>(t);
        text += fmt::format("| {} |", toString(technique));
        for (const double error : interior.techniques[t].errors) text += fmt::format(" {} |", percent(error));
        const double all = interior.error(technique);
        text += fmt::format(" {} | {:.1f} x | {} |\n", percent(all), interior.error(LightTechnique::Environment) / all,
                            timesOf(interior.techniques[t]));
    }
    text += "| noise of the traced images |";
    for (const double noise : interior.noise) text += fmt::format(" {} |", percent(noise));
    return text + fmt::format(" {} | | |\n", percent(interior.meanNoise()));
}

} // namespace

Result<void> writeInteriors(InteriorResults const& results, std::filesystem::path const& out) {
    Json json{ { "machine", results.machine }, { "commit", results.commit }, { "date", results.date } };
    for (InteriorResult const& interior : results.interiors) {
        json["interiors"].push_back(jsonOf(interior));
        std::vector<std::vector<Picture const*>> rows;
        for (size_t camera = 0; camera < interior.traced.size(); ++camera) rows.push_back(rowOf(interior, camera));
        if (auto done = savePng(out / (interior.name + "-all.png"), sheetOf(rows)); !done) return done;
        if (auto done = savePng(out / (interior.name + ".png"), sheetOf({ rows[0] })); !done) return done;
    }
    const std::string text = json.dump(1) + "\n";
    return assets::replaceFile(out / "interiors.json", std::as_bytes(std::span(text.data(), text.size())));
}

std::string textOf(InteriorResults const& results) {
    std::string text;
    for (InteriorResult const& interior : results.interiors) text += tableOf(interior) + "\n";
    return text;
}

} // namespace filament_core::accuracy
