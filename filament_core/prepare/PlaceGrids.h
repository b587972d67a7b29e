// SPDX-License-Identifier: Apache-2.0
/// PlaceGrids: which irradiance grids a view uses, and the fields of the renderables that they light.
///   In      the grids of the scene, the view, and the fields of earlier frames.
///   Out     a GridPacket, and DrawCall::firstField of the main view. A view that only grids light gets the factor of
///           ambient light.
///   Choice  draws of lit materials in which the box of some object meets that of a grid. All objects of such a draw
///           have fields.
///   Bits    a field depends on the box of its renderable, the grids and the environment: known fields are those that
///           would be fitted.
///   Thread  jobs over renderables; each writes its own field.
///   Memory  the arena: 512 B an object with a field. The cache: 260 B a renderable of the scene, while it has grids.
///   Fails   std::bad_alloc.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/FitField.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/ViewInput.h"
#include "jobsystem/JobSystem.h"

#include <cstdint>
#include <vector>

namespace filament_core::prepare {

/// Fields of earlier frames, by position of the renderable.
class FieldCache {
public:
    struct Entry {
        FieldBox box{};
        LightField field{};
        bool isKnown = false;
    };

    /// What the fields of a frame depend on besides their boxes. If it differs from before, none is known.
    struct Lighting {
        uint64_t scene = 0, changes = 0;
        IrradianceSh environment{};
        friend bool operator==(Lighting const&, Lighting const&) = default;
    };
    void begin(Lighting const& lighting, size_t renderables);
    Entry& operator[](size_t renderable) { return mEntries[renderable]; }

private:
    Lighting mLighting;
    std::vector<Entry> mEntries;
};

/// The grids that reach into the view. Before lists of lights are copied.
GridPacket findGrids(Arena& arena, scene::SceneData const& scene, ViewInput const& view, ViewPacket& packet);

/// After the last change of the draws of the main view.
void placeFields(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewInput const& view,
                 FieldCache* cache, FramePacket& packet);

} // namespace filament_core::prepare
