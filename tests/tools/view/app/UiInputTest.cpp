// SPDX-License-Identifier: Apache-2.0
// What hands do between two frames reaches the interface whole.
#include "tools/view/app/UiInput.h"
#include "tools/view/ui/UiContext.h"

#include <gtest/gtest.h>

#include <imgui.h>
#include <imgui_stdlib.h>

#include <array>

namespace filament_core::view {
namespace {

constexpr int kBackspace = 259; // of GLFW

/// Two buttons and a text field, in a window that covers the upper left of the display.
class UiInputTest : public testing::Test {
protected:
    UiInputTest() {
        unsigned char* pixels = nullptr;
        int width = 0, height = 0;
        ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
        frame();
        frame();
    }
    bool frame() {
        const bool hasMore = input.beginFrame();
        mContext.newFrame({ 800, 600 }, 1.0f / 60);
        ImGui::SetNextWindowPos({ 0, 0 });
        ImGui::SetNextWindowSize({ 200, 200 });
        ImGui::Begin("window", nullptr, ImGuiWindowFlags_NoTitleBar);
        for (size_t i = 0; i < clicks.size(); ++i) {
            clicks[i] += ImGui::Button(i == 0 ? "one" : "two", { 100, 40 }) ? 1 : 0;
            places[i] = { ImGui::GetItemRectMin().x + 50, ImGui::GetItemRectMin().y + 20 };
        }
        if (focusField) ImGui::SetKeyboardFocusHere();
        ImGui::InputText("##field", &text);
        ImGui::End();
        ImGui::Render();
        return hasMore;
    }
    void frames() {
        for (int i = 0; i < 20 && frame(); ++i) {
        }
        frame();
        frame();
    }
    void button(bool isDown) { input.pass(MouseButtonEvent{ MouseButton::Left, isDown, {} }); }
    void click(float2 place) {
        input.pass(MouseMoveEvent{ place });
        button(true);
        button(false);
    }

    UiContext mContext;
    UiInput input;
    std::array<int, 2> clicks{};
    std::array<float2, 2> places{};
    std::string text;
    bool focusField = false;
};

TEST_F(UiInputTest, AClickWithinOneFrameIsAClick) {
    click(places[0]);
    frames();
    EXPECT_EQ(clicks[0], 1);
    EXPECT_EQ(clicks[1], 0);
}

TEST_F(UiInputTest, EveryClickOfAFrameIsOneWhereThePointerWas) {
    click(places[0]);
    click(places[1]);
    click(places[1]);
    click({ 700, 500 });
    frames();
    EXPECT_EQ(clicks[0], 1);
    EXPECT_EQ(clicks[1], 2);
}

TEST_F(UiInputTest, KeysThatAreTappedWithinAFrameWrite) {
    focusField = true;
    frames();
    focusField = false;
    input.pass(TextEvent{ 'a' });
    input.pass(TextEvent{ 'b' });
    input.pass(TextEvent{ 'c' });
    for (int i = 0; i < 2; ++i) {
        input.pass(KeyEvent{ kBackspace, true, {} });
        input.pass(KeyEvent{ kBackspace, false, {} });
    }
    frames();
    EXPECT_EQ(text, "a");
}

TEST_F(UiInputTest, APressBelongsToWhatThePointerIsOverNow) {
    input.pass(MouseMoveEvent{ { 700, 500 } });
    frames();
    input.pass(MouseMoveEvent{ places[0] });
    EXPECT_TRUE(input.pass(MouseButtonEvent{ MouseButton::Left, true, {} }))
            << "over the window, without a frame between";
    EXPECT_TRUE(input.pass(MouseButtonEvent{ MouseButton::Left, false, {} }));
    frames();
    input.pass(MouseMoveEvent{ { 700, 500 } });
    EXPECT_FALSE(input.pass(MouseButtonEvent{ MouseButton::Left, true, {} })) << "beside it";
}

TEST_F(UiInputTest, LosingTheFocusLetsGo) {
    input.pass(MouseMoveEvent{ places[0] });
    button(true);
    input.pass(FocusEvent{ false });
    frames();
    EXPECT_FALSE(ImGui::GetIO().MouseDown[0]);
    EXPECT_EQ(clicks[0], 0) << "it was not released over the button";
}

TEST_F(UiInputTest, TextsAreCopiedWithinTheProgramOrToTheWindowSystem) {
    ImGui::SetClipboardText("inside");
    EXPECT_EQ(input.pasted(), "inside");
    input.copy("again");
    EXPECT_STREQ(ImGui::GetClipboardText(), "again");
}

TEST(UiClipboard, UsesThatOfTheWindowSystem) {
    std::string system = "from another program";
    UiContext context;
    UiInput input({ .set = [&](std::string const& text) { system = text; }, .get = [&] { return system; } });
    EXPECT_STREQ(ImGui::GetClipboardText(), "from another program");
    input.copy("ours");
    EXPECT_EQ(system, "ours");
}

} // namespace
} // namespace filament_core::view
