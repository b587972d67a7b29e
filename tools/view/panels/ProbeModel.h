// SPDX-License-Identifier: Apache-2.0
/// ProbeModel: what the panel of probes, grids and bakes does to a document, as plain functions.
///   Thread  any; values.
#pragma once

#include "tools/view/document/Document.h"

#include <filament_core/Box.h>

#include <string>
#include <string_view>
#include <vector>

namespace filament_core::view {

/// What a bake makes of the document's model.
enum class BakeKind : uint8_t { Lightmap, Grid };

/// As a hand sets them.
struct BakeSettings {
    BakeKind kind = BakeKind::Lightmap;
    float texelsPerMeter = 16; ///< Lightmap, [0.1, 256]
    int paths = 256;           ///< of a texel or of a probe, [32, 65536]
    float spacingMeters = 1;   ///< Grid: of its first probes, [0.01, 100]
    float error = 0.05f;       ///< Grid: at held-out points, [0.001, 1]
};

struct BakeProgress {
    bool isRunning = false;
    double share = 0; ///< [0, 1]
    std::string line{};
    friend bool operator==(BakeProgress const&, BakeProgress const&) = default;
};

/// A probe over the whole box, which becomes the last one. Its name is new.
void addProbe(Document& document, Box const& bounds);
void copyProbe(Document& document, size_t probe);

/// The lines of Renderer::explain() about probes and grids, in its order: which are used, and why the others are not.
std::vector<std::string> probeLines(std::string_view explanation);

} // namespace filament_core::view
