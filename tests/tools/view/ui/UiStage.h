// SPDX-License-Identifier: Apache-2.0
/// An engine that draws interfaces over a ground of one colour, and both APIs compared.
#pragma once

#include "tests/filament_core/engine/RenderFixture.h"
#include "tools/view/ui/UiContext.h"
#include "tools/view/ui/UiRenderer.h"

#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace filament_core::test {

using view::UiContext;
using view::UiRenderer;
using Codes = std::array<uint8_t, 4>;

inline constexpr Codes kGround{ 40, 80, 120, 255 };

inline Codes codesAt(Image const& image, uint32_t x, uint32_t y) {
    Codes codes{};
    std::memcpy(codes.data(), image.pixels.data() + (size_t{ y } * image.width + x) * 4, 4);
    return codes;
}

/// Of ImGui's own font, at its size.
inline ImFontGlyph const& glyphOf(UiContext& context, char letter) {
    ImFont& font = *context.fonts().Fonts[0];
#if IMGUI_VERSION_NUM >= 19200
    return *font.GetFontBaked(font.LegacySize)->FindGlyph(static_cast<ImWchar>(letter));
#else
    return *font.FindGlyph(static_cast<ImWchar>(letter));
#endif
}

inline ImU32 imColor(Codes const& codes) { return IM_COL32(codes[0], codes[1], codes[2], codes[3]); }

class UiStage {
public:
    /// `validation`: of the stream and of the API, which allocates.
    UiStage(Backend backend, uint2 pixels, bool validation = true)
            : size(pixels),
              engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = validation }))),
              ground(engine), groundRenderer(engine), ui(std::move(*UiRenderer::create(engine))),
              target(engine.own(engine.create(SwapChainDesc{ .size = pixels }))) {}
    ~UiStage() { expectNoErrors(engine); }

    void renderGround() {
        View view{ .size = size, .clearColor = float4(kGround[0], kGround[1], kGround[2], 255) / 255.0f };
        view.display = { .toneMapper = ToneMapper::Linear, .outputSpace = OutputSpace::LinearRec709 };
        groundRenderer.render(ground, view, target);
    }
    void render(ImDrawData const& drawData) {
        renderGround();
        ui.render(drawData, target, size);
    }
    Image read() {
        auto image = groundRenderer.waitPixels(groundRenderer.readPixels(target));
        EXPECT_TRUE(image);
        return image ? std::move(*image) : Image{};
    }

    uint2 size;
    Engine engine;
    Scene ground;
    Renderer groundRenderer;
    UiRenderer ui;
    Owned<SwapChain> target;
};

/// What both APIs make of the same draw lists; expects the same bits.
inline Image drawnByBoth(uint2 pixels, std::function<ImDrawData*(UiStage&)> const& draw) {
    std::vector<Image> images;
    for (const Backend backend : kBothApis) {
        UiStage stage(backend, pixels);
        stage.render(*draw(stage));
        images.push_back(stage.read());
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels) << differenceOf(images[0], images[1]).pixels << " pixels differ";
    return std::move(images[0]);
}

/// One frame whose background list is filled by `fill`.
inline Image drawnByBoth(uint2 pixels, std::function<void(ImDrawList&)> const& fill) {
    UiContext context;
    return drawnByBoth(pixels, [&](UiStage& stage) {
        stage.ui.uploadFonts(context.fonts());
        context.newFrame(stage.size, 1.0f / 60);
        fill(*ImGui::GetBackgroundDrawList());
        ImGui::Render();
        return ImGui::GetDrawData();
    });
}

} // namespace filament_core::test
