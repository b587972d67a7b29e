// SPDX-License-Identifier: Apache-2.0
/// What names the things that pixels show: the node above them, the instance that they are drawn with, and the handles
/// of what an engine keeps.
///   Thread  the app thread.   Memory  nothing is kept.
#pragma once

#include "filament_core/engine/EngineImpl.h"
#include "filament_core/engine/SceneImpl.h"
#include "filament_core/prepare/NumberObjects.h"

#include <string>
#include <vector>

namespace filament_core::engine {

/// Name of the nearest node with a name, upwards; may be empty.
inline std::string nameAbove(Scene const& scene, Node node) {
    while (node && scene.name(node).empty()) node = scene.parent(node);
    return node ? scene.name(node) : std::string();
}

/// What a renderable of the scene is drawn with; null: none, or no renderable.
inline scene::MaterialInstance const* shownInstance(Scene const& scene, Renderable renderable) {
    if (!renderable) return nullptr;
    scene::Renderables const& renderables = scene.impl().upToDate().renderables;
    return renderables.drawables[renderables.drawable[renderables.index.at(renderable)]].material;
}

/// What a number of Aov::MaterialId names, which may be destroyed and still be drawn; null: there are not so many.
inline scene::Material const* materialAt(Scene const& scene, uint32_t number) {
    const std::vector all = prepare::materialsOf(scene.impl().data.renderables);
    return number >= 1 && number <= all.size() ? all[number - 1] : nullptr;
}

/// The same of Aov::MaterialInstanceId.
inline scene::MaterialInstance const* instanceAt(Scene const& scene, uint32_t number) {
    const std::vector all = prepare::instancesOf(scene.impl().data.renderables);
    return number >= 1 && number <= all.size() ? all[number - 1] : nullptr;
}

/// The handle of what the engine keeps at this address; none: it is nothing of its own, or was destroyed and is still
/// in use.
template <class Table, class State>
auto handleOf(Table& table, State const* state) {
    decltype(table.add()) found{};
    table.forEachHeld([&](auto handle, auto const& held) {
        if (&held == state && table.isLive(handle)) found = handle;
    });
    return found;
}

} // namespace filament_core::engine
