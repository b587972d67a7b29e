// SPDX-License-Identifier: Apache-2.0
/// A small model that has something for every panel, and a stage with panels, an interface and a mouse, but no window.
#pragma once

#include "tests/filament_core/engine/RenderFixture.h"
#include "tools/view/panels/Panels.h"
#include "tools/view/stage/Stage.h"
#include "tools/view/ui/UiContext.h"
#include "tools/view/ui/UiRenderer.h"

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

namespace filament_core::test {

/// A triangle with a morph target, on a node that an animation moves; a second node with a lamp; a camera; two
/// materials, one of them of a variant.
inline std::filesystem::path writePanelModel() {
    constexpr const char* kModel = R"({ "asset": { "version": "2.0" },
"extensionsUsed": ["KHR_lights_punctual", "KHR_materials_variants"],
"extensions": { "KHR_lights_punctual": { "lights": [ { "type": "point", "name": "bulb", "intensity": 50 } ] },
                "KHR_materials_variants": { "variants": [ { "name": "night" } ] } },
"scene": 0, "scenes": [ { "nodes": [0, 3] } ],
"nodes": [ { "name": "body", "children": [1, 2] },
           { "name": "sail", "mesh": 0 },
           { "name": "mast", "translation": [0, 1, 1], "extensions": { "KHR_lights_punctual": { "light": 0 } } },
           { "name": "eye", "camera": 0, "translation": [0, 0, 3] } ],
"cameras": [ { "name": "portrait", "type": "perspective", "perspective": { "yfov": 0.6, "znear": 0.1 } } ],
"materials": [ { "name": "canvas", "doubleSided": true,
                 "pbrMetallicRoughness": { "baseColorFactor": [0.8, 0.3, 0.2, 1], "metallicFactor": 0 } },
               { "name": "moonlit", "emissiveFactor": [0, 0.2, 0.4] } ],
"meshes": [ { "name": "triangle", "extras": { "targetNames": ["billow"] }, "weights": [0.25],
  "primitives": [ { "attributes": { "POSITION": 0 }, "indices": 4, "material": 0, "targets": [ { "POSITION": 1 } ],
    "extensions": { "KHR_materials_variants": { "mappings": [ { "material": 1, "variants": [0] } ] } } } ] } ],
"animations": [ { "name": "drift", "samplers": [ { "input": 2, "output": 3 } ],
                  "channels": [ { "sampler": 0, "target": { "node": 1, "path": "translation" } } ] } ],
"buffers": [ { "byteLength": 112, "uri": "data:application/octet-stream;base64,AAAAvwAAAL8AAAAAAAAAPwAAAL8AAAAAAAAAAAAAAD8AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAzczMPs3MzD4AAAAAAAAAAAAAAEAAAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAEAAgAAAA==" } ],
"bufferViews": [ { "buffer": 0, "byteLength": 36 }, { "buffer": 0, "byteOffset": 36, "byteLength": 36 },
                 { "buffer": 0, "byteOffset": 72, "byteLength": 8 }, { "buffer": 0, "byteOffset": 80, "byteLength": 24 },
                 { "buffer": 0, "byteOffset": 104, "byteLength": 6 } ],
"accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-0.5, -0.5, 0], "max": [0.5, 0.5, 0] },
               { "bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [0.4, 0.4, 0] },
               { "bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [2] },
               { "bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3" },
               { "bufferView": 4, "componentType": 5123, "count": 3, "type": "SCALAR" } ] })";
    const std::filesystem::path path = folderOfThisTest() / "sail.gltf";
    std::ofstream(path) << kModel;
    return path;
}

/// How many are exactly so.
inline size_t pixelsOf(Image const& image, std::array<uint8_t, 4> color) {
    size_t count = 0;
    for (size_t i = 0; i < image.pixels.size(); i += 4) count += std::memcmp(&image.pixels[i], color.data(), 4) == 0;
    return count;
}

class PanelStage {
public:
    explicit PanelStage(Backend backend, uint2 pixels = { 1280, 720 }) : size(pixels) {
        auto made = view::Stage::create({ .engine = { .backend = backend, .workers = 1, .validation = true },
                                          .watchesFiles = false }); // two stages of a test write the same file
        if (!made) throw std::runtime_error(made.error().message);
        stage = std::move(*made);
        document.model.file = writePanelModel();
        document.model.fit = false;
        document.view.size = size;
        document.view.camera = Camera::lookAt({ 0.6, 0.4, 3 }, { 0, 0.1, 0 });
        document.view.clearColor = { 0.05f, 0.06f, 0.08f, 1 };
        document.lights.push_back({ .name = "sun", .light = SunLight{ .directionWorld = { -0.3f, -1, -1 } } });
        stage->apply(document);
        stage->finishLoading();
        stage->poll();
        ui = std::make_unique<view::UiRenderer>(std::move(*view::UiRenderer::create(stage->engine())));
        ui->uploadFonts(context.fonts());
        target = stage->engine().own(stage->engine().create(SwapChainDesc{ .size = size }));
        ImGui::GetIO().MousePos = { -1000, -1000 };
    }
    ~PanelStage() { expectNoErrors(stage->engine()); }

    /// A frame of the interface alone: nothing is drawn by a device.
    void interfaceFrame() {
        context.newFrame(size, 1.0f / 60);
        panels.draw(document, *stage);
        ImGui::Render();
    }
    void frame() {
        interfaceFrame();
        stage->apply(document);
        stage->poll();
        stage->render(target);
        ui->render(*ImGui::GetDrawData(), target, size);
        panels.collect(*stage);
    }
    void open(std::string_view panel) {
        panels.state.opensPanel = panel;
        for (int i = 0; i < 3; ++i) interfaceFrame(); // columns and tabs take a frame to fit
    }
    /// Presses and releases the left button there.
    void click(ImVec2 place) {
        ImGuiIO& io = ImGui::GetIO();
        io.MousePos = place;
        interfaceFrame();
        io.MouseDown[0] = true;
        interfaceFrame();
        io.MouseDown[0] = false;
        interfaceFrame();
    }
    void type(const char* text) {
        ImGui::GetIO().AddInputCharactersUTF8(text);
        interfaceFrame();
        interfaceFrame();
    }
    Image read() {
        auto image = stage->renderer().waitPixels(stage->renderer().readPixels(target));
        EXPECT_TRUE(image);
        return image ? std::move(*image) : Image{};
    }

    uint2 size;
    view::UiContext context;
    std::unique_ptr<view::Stage> stage;
    view::Document document;
    view::Panels panels;
    std::unique_ptr<view::UiRenderer> ui;
    Owned<SwapChain> target;
};

} // namespace filament_core::test
