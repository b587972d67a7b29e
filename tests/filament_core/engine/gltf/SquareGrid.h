// SPDX-License-Identifier: Apache-2.0
/// SquareGrid: many squares of 2 x 2 metres in one glTF file, side by side in rows from the lower left, and their
/// pixels in one image of both APIs: a scene for each square would take minutes.
#pragma once

#include "tests/filament_core/assets/gltf/GltfTestFile.h"
#include "tests/filament_core/engine/materials/MaterialStage.h"

#include <filament_core/Gltf.h>

#include <functional>
#include <memory>

namespace filament_core::test {

struct SquareGrid {
    uint32_t columns = 0, pixels = 0; ///< pixels of a square, each way
    size_t count = 0;

    uint32_t rows() const { return static_cast<uint32_t>((count + columns - 1) / columns); }

    /// Makes `primitives`, one for each square and in the plane z = 0, the scene of the file.
    void place(assets::test::TestFile& file, std::vector<assets::test::Json> const& primitives) const {
        using assets::test::Json;
        Json &root = file.root, &nodes = root["nodes"] = Json::array(), &meshes = root["meshes"] = Json::array();
        Json& shown = root["scenes"][0]["nodes"] = Json::array();
        for (size_t i = 0; i < primitives.size(); ++i) {
            meshes.push_back({ { "primitives", Json::array({ primitives[i] }) } });
            nodes.push_back({ { "mesh", i }, { "translation", { 2 * (i % columns) + 1, 2 * (i / columns) + 1, 0 } } });
            shown.push_back(i);
        }
    }

    /// Scene-linear, from z = 5 `side`; `light` adds lights to the scene and may change the view.
    Image draw(assets::test::Bytes const& file, double side, std::function<void(MaterialStage&)> const& light) const {
        return onBothApis([&](MaterialStage& stage) {
            Result<Model> model = loadGltf(stage.engine, GltfMemory{ .file = file, .name = "squares.glb" });
            ASSERT_TRUE(model) << model.error().message;
            const auto kept = std::make_shared<Model>(std::move(*model));
            stage.keep(kept);
            stage.scene.add(*kept);
            stage.view.size = { columns * pixels, rows() * pixels };
            stage.view.camera = Camera::lookAt({ columns, rows(), side * 5 }, { columns, rows(), 0 },
                                               { .orthographicHeight = 2.0f * float(rows()) });
            stage.view.camera.exposure = { .aperture = 1, .shutterSeconds = 1, .iso = 100 };
            light(stage);
        });
    }

    /// The upper left pixel of a square.
    uint2 cornerOf(size_t i, double side) const {
        const auto column = static_cast<uint32_t>(i % columns), row = static_cast<uint32_t>(i / columns);
        return uint2(side > 0 ? column : columns - 1 - column, rows() - 1 - row) * pixels;
    }
};

} // namespace filament_core::test
