// SPDX-License-Identifier: Apache-2.0
/// AnimationModel: animations, variants and morph targets of the model that is drawn, and what their panel does to a
/// Document.
///   Thread  the app thread.
#pragma once

#include "tools/view/document/Document.h"

#include <cstdint>
#include <string>
#include <vector>

namespace filament_core::view {

class Stage;

struct AnimationRow {
    std::string name{}; ///< "animation 2" if the file gives none
    double seconds = 0; ///< how long it is
};
std::vector<AnimationRow> animationRows(Stage const& stage);

/// None: the rest pose. Another animation begins at its start.
void chooseAnimation(Document& document, std::optional<uint32_t> animation);
void setAnimationTime(Document& document, double seconds); ///< and stops
void togglePlaying(Document& document);                    ///< from the first animation if none is chosen

/// "" first, which is the file's own materials.
std::vector<std::string> variantRows(Stage const& stage);

struct MorphRow {
    std::string target{};
    float weight = 0; ///< of its first primitive, as edited
    uint32_t primitives = 1;
    bool isEdited = false;
};
/// One of each name.
std::vector<MorphRow> morphRows(Stage const& stage, Document const& document);
void resetMorph(Document& document, std::string_view target);

} // namespace filament_core::view
