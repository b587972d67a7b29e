// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/AnimationModel.h"

#include "tools/view/stage/Stage.h"

#include <fmt/format.h>

#include <algorithm>

namespace filament_core::view {

std::vector<AnimationRow> animationRows(Stage const& stage) {
    std::vector<AnimationRow> rows;
    Model const* model = stage.model();
    for (uint32_t i = 0; model && i < model->animationCount(); ++i) {
        std::string const& name = model->animationName(i);
        rows.push_back({ name.empty() ? fmt::format("animation {}", i + 1) : name, model->animationSeconds(i) });
    }
    return rows;
}

void chooseAnimation(Document& document, std::optional<uint32_t> animation) {
    if (document.playback.animation == animation) return;
    document.playback.animation = animation;
    document.playback.seconds = 0;
    if (!animation) document.playback.isPlaying = false;
}

void setAnimationTime(Document& document, double seconds) {
    document.playback.seconds = seconds;
    document.playback.isPlaying = false;
}

void togglePlaying(Document& document) {
    if (!document.playback.animation) chooseAnimation(document, 0);
    document.playback.isPlaying = !document.playback.isPlaying;
}

std::vector<std::string> variantRows(Stage const& stage) {
    std::vector<std::string> rows{ "" };
    if (Model const* model = stage.model())
        rows.insert(rows.end(), model->variantNames().begin(), model->variantNames().end());
    return rows;
}

std::vector<MorphRow> morphRows(Stage const& stage, Document const& document) {
    std::vector<MorphRow> rows;
    if (!stage.modelCopy()) return rows;
    for (CopyMorphTarget const& target : stage.modelCopy()->morphTargets()) {
        if (const auto row = std::ranges::find(rows, target.name, &MorphRow::target); row != rows.end()) {
            ++row->primitives;
            continue;
        }
        const auto edit = std::ranges::find(document.morphs, target.name, &MorphEdit::target);
        const bool isEdited = edit != document.morphs.end();
        rows.push_back(
                { .target = target.name, .weight = isEdited ? edit->weight : target.weight, .isEdited = isEdited });
    }
    return rows;
}

void resetMorph(Document& document, std::string_view target) {
    std::erase_if(document.morphs, [&](MorphEdit const& edit) { return edit.target == target; });
}

} // namespace filament_core::view
