// SPDX-License-Identifier: Apache-2.0
// Interfaces over an image: their bytes, the edges of their rectangles, their text and their textures, on both APIs.
#include "tests/tools/view/ui/UiStage.h"
#include "tools/filament-render/HeapCounter.h"
#include "tools/view/ui/ImGuiVersions.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

namespace filament_core {
namespace {

using test::Codes;
using test::codesAt;
using test::drawnByBoth;
using test::glyphOf;
using test::imColor;
using test::kGround;
using test::UiContext;
using test::UiStage;
using view::drawLists;

constexpr uint2 kSize(96, 64);

TEST(UiRenderer, OpaqueColoursArriveAsTheirBytes) {
    const auto colorOf = [](uint32_t code) {
        return Codes{ static_cast<uint8_t>(code), static_cast<uint8_t>(255 - code), static_cast<uint8_t>(code * 37),
                      255 };
    };
    const Image image = drawnByBoth({ 64, 32 }, [&](ImDrawList& list) {
        for (uint32_t code = 0; code < 256; ++code) {
            const ImVec2 least(static_cast<float>(code % 32 * 2), static_cast<float>(code / 32 * 4));
            list.AddRectFilled(least, { least.x + 2, least.y + 4 }, imColor(colorOf(code)));
        }
    });
    for (uint32_t y = 0; y < 32; ++y)
        for (uint32_t x = 0; x < 64; ++x) ASSERT_EQ(codesAt(image, x, y), colorOf(y / 4 * 32 + x / 2)) << x << ' ' << y;
}

TEST(UiRenderer, Row0IsTheTopAndWhatIsNotCoveredStays) {
    const Image image = drawnByBoth(kSize, [](ImDrawList& list) {
        list.AddRectFilled({ 0, 0 }, { 1, 1 }, IM_COL32_WHITE);
    });
    for (uint32_t y = 0; y < kSize.y; ++y)
        for (uint32_t x = 0; x < kSize.x; ++x)
            ASSERT_EQ(codesAt(image, x, y), (x + y == 0 ? Codes{ 255, 255, 255, 255 } : kGround)) << x << ' ' << y;
}

TEST(UiRenderer, RectanglesCutToThePixelWhereverTheirEdgesLie) {
    std::mt19937 random(3);
    const auto edge = [&] { return static_cast<float>(random() % 1600) / 16 - 2; }; // sixteenths, also outside
    for (int round = 0; round < 40; ++round) {
        const float2 a(edge(), edge() * 0.7f), b(edge(), edge() * 0.7f);
        const float2 least = glm::min(a, b), most = glm::max(a, b);
        const Codes color{ 200, static_cast<uint8_t>(round), 3, 255 };
        const Image image = drawnByBoth(kSize, [&](ImDrawList& list) {
            list.PushClipRect({ least.x, least.y }, { most.x, most.y });
            list.AddRectFilled({ -10, -10 }, { 500, 500 }, imColor(color));
            list.PopClipRect();
        });
        for (uint32_t y = 0; y < kSize.y; ++y) {
            for (uint32_t x = 0; x < kSize.x; ++x) {
                const float2 center = float2(x, y) + 0.5f;
                const bool isInside =
                        glm::all(glm::greaterThanEqual(center, least)) && glm::all(glm::lessThan(center, most));
                ASSERT_EQ(codesAt(image, x, y), (isInside ? color : kGround)) << x << ' ' << y << " of round " << round;
            }
        }
    }
}

/// Slanted edges, gradients and anti-aliased lines: whatever a rectangle leaves is what it would have been without.
TEST(UiRenderer, ARectangleChangesNothingOfWhatItShows) {
    const auto fill = [](ImDrawList& list) {
        list.AddTriangleFilled({ 3.3f, -20.7f }, { 90.1f, 31.9f }, { 11.2f, 99.4f }, IM_COL32(250, 200, 10, 130));
        list.AddRectFilledMultiColor({ 5, 5 }, { 91, 60 }, IM_COL32(255, 0, 0, 90), IM_COL32(0, 255, 0, 200),
                                     IM_COL32(0, 0, 255, 10), IM_COL32_WHITE);
        list.AddCircle({ 48, 32 }, 25.5f, IM_COL32(0, 0, 0, 255), 0, 2.5f);
        list.AddLine({ 0, 0 }, { 96, 64 }, IM_COL32(255, 255, 255, 255), 1.3f);
    };
    const Image whole = drawnByBoth(kSize, fill);
    const uint2 least(17, 9), most(71, 50);
    const Image cut = drawnByBoth(kSize, [&](ImDrawList& list) {
        list.PushClipRect({ 17, 9 }, { 71, 50 });
        fill(list);
        list.PopClipRect();
    });
    size_t changed = 0;
    for (uint32_t y = 0; y < kSize.y; ++y) {
        for (uint32_t x = 0; x < kSize.x; ++x) {
            const bool isInside = x >= least.x && x < most.x && y >= least.y && y < most.y;
            ASSERT_EQ(codesAt(cut, x, y), isInside ? codesAt(whole, x, y) : kGround) << x << ' ' << y;
            changed += codesAt(whole, x, y) != kGround;
        }
    }
    EXPECT_GT(changed, kSize.x * kSize.y / 2);
}

TEST(UiRenderer, MixesCodesAsTheyAre) {
    const Image image = drawnByBoth({ 256, 4 }, [](ImDrawList& list) {
        for (int alpha = 0; alpha < 256; ++alpha) {
            const auto x = static_cast<float>(alpha);
            list.AddRectFilled({ x, 0 }, { x + 1, 4 }, IM_COL32(255, 20, 200, alpha));
            list.AddRectFilled({ x, 2 }, { x + 1, 4 }, IM_COL32(0, 100, 255, 255 - alpha));
        }
    });
    const Codes first{ 255, 20, 200 }, second{ 0, 100, 255 };
    constexpr double kRounding = 1.6; // of the colour, of its product with alpha, and of the mixture
    for (uint32_t x = 0; x < 256; ++x) {
        const double alpha = x / 255.0;
        for (size_t c = 0; c < 3; ++c) {
            const double once = first[c] * alpha + kGround[c] * (1 - alpha);
            EXPECT_NEAR(codesAt(image, x, 0)[c], once, kRounding) << x;
            EXPECT_NEAR(codesAt(image, x, 3)[c], second[c] * (1 - alpha) + once * alpha, kRounding) << x;
        }
    }
}

/// The texels of the atlas that a glyph shows.
TEST(UiRenderer, WhiteTextOnBlackIsTheFontAtlas) {
    const char* text = "Wg&@ #|0O";
    const auto fill = [&](ImDrawList& list) {
        list.AddRectFilled({ 0, 0 }, { 96, 64 }, IM_COL32_BLACK);
        list.AddText({ 7, 11 }, IM_COL32_WHITE, text);
    };
    const Image image = drawnByBoth(kSize, fill);
    UiContext context;
    unsigned char* texels = nullptr;
    int width = 0, height = 0;
    context.fonts().GetTexDataAsAlpha8(&texels, &width, &height);
    float pen = 7;
    size_t inked = 0;
    for (const char* letter = text; *letter; ++letter) {
        ImFontGlyph const& glyph = glyphOf(context, *letter);
        const auto u = static_cast<int>(std::lround(glyph.U0 * static_cast<float>(width)));
        const auto v = static_cast<int>(std::lround(glyph.V0 * static_cast<float>(height)));
        const auto columns = static_cast<int>(glyph.X1 - glyph.X0), rows = static_cast<int>(glyph.Y1 - glyph.Y0);
        for (int y = 0; y < rows && glyph.Visible; ++y) {
            for (int x = 0; x < columns; ++x) {
                const uint8_t ink = texels[(v + y) * width + u + x];
                const Codes seen = codesAt(image, static_cast<uint32_t>(pen + glyph.X0) + static_cast<uint32_t>(x),
                                           static_cast<uint32_t>(11 + glyph.Y0) + static_cast<uint32_t>(y));
                ASSERT_EQ(seen, (Codes{ ink, ink, ink, 255 })) << *letter << ' ' << x << ' ' << y;
                inked += ink > 0;
            }
        }
        pen += glyph.AdvanceX;
    }
    EXPECT_GT(inked, 100u);
}

TEST(UiRenderer, ShowsPicturesTexelByTexelAndNothingOnceTheyAreRemoved) {
    std::array<uint8_t, 16 * 8 * 4> texels{};
    std::mt19937 random(1);
    for (size_t i = 0; i < texels.size(); ++i) texels[i] = i % 4 == 3 ? 255 : static_cast<uint8_t>(random());
    for (const bool isRemoved : { false, true }) {
        UiContext context;
        const Image image = drawnByBoth(kSize, [&](UiStage& stage) {
            stage.ui.uploadFonts(context.fonts());
            const Owned<Texture> texture = stage.engine.own(stage.engine.create(TextureDesc{
                    .width = 16, .height = 8, .pixels = std::as_bytes(std::span(texels)), .name = "picture" }));
            const ImTextureID id = stage.ui.add(texture); // keeps it
            context.newFrame(stage.size, 0);
            ImGui::GetBackgroundDrawList()->AddImage(id, { 5, 6 }, { 21, 14 });
            ImGui::GetBackgroundDrawList()->AddRectFilled({ 0, 0 }, { 2, 2 }, IM_COL32_WHITE);
            ImGui::Render();
            if (isRemoved) {
                stage.ui.remove(id);
                EXPECT_NE(stage.ui.add(texture), id) << "never the same again";
            }
            return ImGui::GetDrawData();
        });
        EXPECT_EQ(codesAt(image, 1, 1), (Codes{ 255, 255, 255, 255 }));
        for (uint32_t y = 0; y < 8; ++y) {
            for (uint32_t x = 0; x < 16; ++x) {
                Codes expected = kGround;
                if (!isRemoved) std::memcpy(expected.data(), &texels[(y * 16 + x) * 4], 4);
                ASSERT_EQ(codesAt(image, 5 + x, 6 + y), expected) << x << ' ' << y;
            }
        }
    }
}

TEST(UiRenderer, DrawsMoreVerticesThanSixteenBitsCount) {
    constexpr uint32_t kColumns = 160, kRows = 120; // 76 800 vertices
    const auto colorOf = [](uint32_t x, uint32_t y) {
        return Codes{ static_cast<uint8_t>(x), static_cast<uint8_t>(y), static_cast<uint8_t>(x * y), 255 };
    };
    const Image image = drawnByBoth({ kColumns, kRows }, [&](ImDrawList& list) {
        for (uint32_t y = 0; y < kRows; ++y)
            for (uint32_t x = 0; x < kColumns; ++x)
                list.AddRectFilled({ static_cast<float>(x), static_cast<float>(y) },
                                   { static_cast<float>(x + 1), static_cast<float>(y + 1) }, imColor(colorOf(x, y)));
        EXPECT_GT(list.VtxBuffer.Size, 65536);
        EXPECT_GT(list.CmdBuffer.Size, 1) << "a second command begins where indices end";
    });
    for (uint32_t y = 0; y < kRows; ++y)
        for (uint32_t x = 0; x < kColumns; ++x) ASSERT_EQ(codesAt(image, x, y), colorOf(x, y)) << x << ' ' << y;
}

TEST(UiRenderer, NothingIsSeenOutsideOfTheRectanglesOfBrokenLists) {
    std::mt19937 random(9);
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    for (int round = 0; round < 12; ++round) {
        const uint32_t seed = static_cast<uint32_t>(random());
        const Image image = drawnByBoth(kSize, [&](ImDrawList& list) {
            std::mt19937 own(seed);
            list.PushClipRect({ 20, 10 }, { 60, 40 });
            for (int i = 0; i < 30; ++i) {
                const auto place = [&] {
                    return ImVec2(static_cast<float>(own() % 20000) - 10000, static_cast<float>(own() % 900) - 450);
                };
                list.AddTriangleFilled(place(), place(), place(), static_cast<ImU32>(own()));
            }
            for (int i = 0; i < 20; ++i) { // after anti-aliasing, which would spread them
                ImDrawVert& vertex =
                        list.VtxBuffer[static_cast<int>(own() % static_cast<uint32_t>(list.VtxBuffer.Size))];
                constexpr std::array kBad{ kNan, 1e30f, -1e30f, 1e6f, -1e6f };
                (i % 2 ? vertex.pos.x : vertex.pos.y) = kBad[own() % kBad.size()];
            }
            list.PopClipRect();
        });
        for (uint32_t y = 0; y < kSize.y; ++y)
            for (uint32_t x = 0; x < kSize.x; ++x)
                if (x < 20 || x >= 60 || y < 10 || y >= 40) {
                    ASSERT_EQ(codesAt(image, x, y), kGround) << x << ' ' << y;
                }
    }
}

TEST(UiRenderer, NothingToDrawIsNoView) {
    for (const Backend backend : test::kBothApis) {
        UiContext context;
        UiStage stage(backend, kSize);
        stage.ui.uploadFonts(context.fonts());
        context.newFrame(kSize, 0);
        ImGui::Render();
        stage.renderGround();
        const uint64_t before = stage.engine.statistics().commands;
        stage.ui.render(*ImGui::GetDrawData(), stage.target, kSize);
        EXPECT_EQ(stage.engine.statistics().commands, before);
        context.newFrame(kSize * 2u, 0); // a window that has been resized meanwhile
        ImGui::GetBackgroundDrawList()->AddRectFilled({ 0, 0 }, { 9, 9 }, IM_COL32_WHITE);
        ImGui::Render();
        stage.ui.render(*ImGui::GetDrawData(), stage.target, kSize);
        EXPECT_EQ(stage.engine.statistics().commands, before);
        EXPECT_EQ(codesAt(stage.read(), 1, 1), kGround);
    }
}

TEST(UiRenderer, AFramebufferScaleMultipliesPixels) {
    const auto fill = [](UiContext& context, UiStage& stage, float scale) {
        stage.ui.uploadFonts(context.fonts());
        ImGuiIO& io = ImGui::GetIO();
        io.DeltaTime = 1;
        io.DisplaySize = { static_cast<float>(stage.size.x) / scale, static_cast<float>(stage.size.y) / scale };
        io.DisplayFramebufferScale = { scale, scale };
        ImGui::NewFrame();
        ImGui::GetBackgroundDrawList()->PushClipRect({ 4, 5 }, { 20, 12 });
        ImGui::GetBackgroundDrawList()->AddRectFilled({ 2, 6 }, { 30, 30 }, IM_COL32(9, 8, 7, 255));
        ImGui::Render();
        return ImGui::GetDrawData();
    };
    UiContext context;
    const Image image = drawnByBoth(kSize, [&](UiStage& stage) { return fill(context, stage, 2); });
    for (uint32_t y = 0; y < kSize.y; ++y) {
        for (uint32_t x = 0; x < kSize.x; ++x) {
            const bool isInside = x >= 8 && x < 40 && y >= 12 && y < 24;
            ASSERT_EQ(codesAt(image, x, y), (isInside ? Codes{ 9, 8, 7, 255 } : kGround)) << x << ' ' << y;
        }
    }
}

/// A window with text, a slider and a button at the display scale.
void drawWindow(UiContext& context, uint2 size, float value) {
    context.newFrame(size, 1.0f / 60);
    ImGui::SetNextWindowPos({ 4, 4 });
    ImGui::SetNextWindowSize({ 200 * context.scale(), 90 * context.scale() });
    ImGui::Begin("Window", nullptr, ImGuiWindowFlags_NoResize);
    ImGui::Text("FlightHelmet %.2f", static_cast<double>(value));
    ImGui::SliderFloat("value", &value, 0, 1);
    ImGui::Button("Button");
    ImGui::End();
    ImGui::Render();
}

TEST(UiRenderer, GlyphsOfAnyDisplayScaleLieOnWholePixels) {
    for (const float scale : { 1.0f, 1.25f, 2.0f }) {
        UiContext context(scale);
        const uint2 size(static_cast<uint32_t>(220 * scale), static_cast<uint32_t>(100 * scale));
        const auto draw = [&](UiStage& stage) {
            stage.ui.uploadFonts(context.fonts());
            for (int frame = 0; frame < 2; ++frame) drawWindow(context, size, 0.25f); // windows take a frame to fit
            return ImGui::GetDrawData();
        };
        const Image image = drawnByBoth(size, draw);
        EXPECT_NE(codesAt(image, 40, 20), kGround);
        size_t glyphs = 0;
        ImDrawData const& data = *ImGui::GetDrawData();
        ImFontGlyph const& letter = glyphOf(context, 'F');
        for (ImDrawVert const& vertex : view::drawLists(data)[0]->VtxBuffer) {
            if (vertex.uv.x != letter.U0 || vertex.uv.y != letter.V0) continue;
            EXPECT_EQ(vertex.pos.x, std::floor(vertex.pos.x)) << scale;
            EXPECT_EQ(vertex.pos.y, std::floor(vertex.pos.y)) << scale;
            ++glyphs;
        }
        EXPECT_EQ(glyphs, 1u) << scale;
    }
}

TEST(UiRenderer, UploadsOnlyWhatChangedAndAllocatesNothing) {
    for (const Backend backend : test::kBothApis) {
        UiContext context;
        UiStage stage(backend, { 256, 128 }, false);
        stage.ui.uploadFonts(context.fonts());
        const auto frame = [&](float value) {
            drawWindow(context, stage.size, value);
            stage.render(*ImGui::GetDrawData());
        };
        for (int i = 0; i < 12; ++i) frame(static_cast<float>(i) / 12); // warm
        frame(0.5f);
        const uint64_t uploads = stage.ui.statistics().uploads;
        stage.engine.waitIdle();
        uint64_t before = tools::heapAllocations();
        for (int i = 0; i < 20; ++i) frame(0.5f);
        stage.engine.waitIdle();
        EXPECT_EQ(tools::heapAllocations(), before) << "nothing changes";
        EXPECT_EQ(stage.ui.statistics().uploads, uploads);
        for (int i = 0; i < 12; ++i) frame(static_cast<float>(i) / 12); // the uploads are warm, too
        stage.engine.waitIdle();
        before = tools::heapAllocations();
        for (int i = 0; i < 20; ++i) frame(static_cast<float>(i) / 20);
        stage.engine.waitIdle();
        EXPECT_EQ(tools::heapAllocations(), before) << "everything changes";
        EXPECT_EQ(stage.ui.statistics().uploads, uploads + 32);
        EXPECT_EQ(stage.ui.statistics().draws, 1u);
        EXPECT_EQ(stage.ui.statistics().bufferGrowths, 1u);
    }
}

} // namespace
} // namespace filament_core
