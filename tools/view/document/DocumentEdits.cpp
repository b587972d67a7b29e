// SPDX-License-Identifier: Apache-2.0
#include "tools/view/document/Document.h"

#include <algorithm>
#include <cmath>

namespace filament_core::view {
namespace {

/// The one of them for which `isIt` holds, or a new one.
template <class T, class IsIt>
T& foundOrAdded(std::vector<T>& list, T added, IsIt const& isIt) {
    const auto found = std::ranges::find_if(list, isIt);
    return found == list.end() ? list.emplace_back(std::move(added)) : *found;
}

auto ofParameter(std::string_view material, std::string_view parameter) {
    return [=](auto const& edit) { return edit.material == material && edit.parameter == parameter; };
}

} // namespace

NodeEdit& nodeEdit(Document& document, uint32_t node) {
    return foundOrAdded(document.nodes, NodeEdit{ .node = node },
                        [&](NodeEdit const& edit) { return edit.node == node; });
}

ModelLightEdit& modelLightEdit(Document& document, uint32_t light) {
    return foundOrAdded(document.modelLights, ModelLightEdit{ .light = light },
                        [&](ModelLightEdit const& edit) { return edit.light == light; });
}

void setParameter(Document& document, std::string_view material, std::string_view parameter,
                  ParameterValue const& value) {
    foundOrAdded(document.materials,
                 MaterialEdit{ .material = std::string(material), .parameter = std::string(parameter) },
                 ofParameter(material, parameter))
            .value = value;
}

void resetParameter(Document& document, std::string_view material, std::string_view parameter) {
    std::erase_if(document.materials, ofParameter(material, parameter));
}

void setTexture(Document& document, std::string_view material, std::string_view parameter,
                std::filesystem::path const& file, bool isData) {
    TextureEdit& edit = foundOrAdded(
            document.textures, TextureEdit{ .material = std::string(material), .parameter = std::string(parameter) },
            ofParameter(material, parameter));
    edit.file = file;
    edit.isData = isData;
}

void resetTexture(Document& document, std::string_view material, std::string_view parameter) {
    std::erase_if(document.textures, ofParameter(material, parameter));
}

void setMorph(Document& document, std::string_view target, float weight) {
    foundOrAdded(document.morphs, MorphEdit{ .target = std::string(target) }, [&](MorphEdit const& edit) {
        return edit.target == target;
    }).weight = weight;
}

void removeIdleEdits(Document& document) {
    std::erase_if(document.nodes, [](NodeEdit const& edit) { return edit.isVisible && !edit.parentFromNode; });
    std::erase_if(document.modelLights, [](ModelLightEdit const& edit) { return edit.isOn && !edit.replacement; });
}

Playback advanced(Playback const& playback, double elapsedSeconds, double durationSeconds) {
    if (!playback.isPlaying || !playback.animation) return playback;
    Playback next = playback;
    next.seconds += elapsedSeconds * playback.speed;
    if (!(durationSeconds > 0)) {
        next.seconds = 0;
    } else if (playback.loops) {
        next.seconds -= durationSeconds * std::floor(next.seconds / durationSeconds);
    } else {
        const double end = playback.speed >= 0 ? durationSeconds : 0;
        next.isPlaying = playback.speed >= 0 ? next.seconds < end : next.seconds > end;
        next.seconds = std::clamp(next.seconds, 0.0, durationSeconds);
    }
    return next;
}

} // namespace filament_core::view
