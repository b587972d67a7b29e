// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/ProbeModel.h"

#include <fmt/format.h>

#include <algorithm>

namespace filament_core::view {
namespace {

constexpr float kLeastHalf = 0.05f, kLeastBlend = 0.01f;

std::string freshProbeName(Document const& document) {
    for (size_t i = document.probes.size() + 1;; ++i) {
        std::string name = fmt::format("probe {}", i);
        if (std::ranges::find(document.probes, name, &DocumentProbe::name) == document.probes.end()) return name;
    }
}

} // namespace

void addProbe(Document& document, Box const& bounds) {
    DocumentProbe probe{ .name = freshProbeName(document) };
    if (!bounds.empty()) {
        probe.centerWorld = bounds.center();
        probe.halfExtentMeters = max(float3((bounds.max - bounds.min) * 0.5), float3(kLeastHalf));
        const float3 half = probe.halfExtentMeters;
        probe.blendMeters = std::max(kLeastBlend, 0.1f * std::min({ half.x, half.y, half.z }));
    }
    document.probes.push_back(std::move(probe));
}

void copyProbe(Document& document, size_t probe) {
    DocumentProbe copy = document.probes[probe];
    copy.name = freshProbeName(document);
    document.probes.push_back(std::move(copy));
}

std::vector<std::string> probeLines(std::string_view explanation) {
    std::vector<std::string> lines;
    while (!explanation.empty()) {
        const size_t end = std::min(explanation.find('\n'), explanation.size());
        const std::string_view line = explanation.substr(0, end);
        if (line.starts_with("reflection probe") || line.starts_with("irradiance grid")) lines.emplace_back(line);
        explanation.remove_prefix(std::min(end + 1, explanation.size()));
    }
    return lines;
}

} // namespace filament_core::view
