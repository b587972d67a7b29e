// SPDX-License-Identifier: Apache-2.0
// The panels themselves, without a window: their images on both APIs, and what clicks and keys do to the document.
#include "tests/tools/view/panels/PanelStage.h"
#include "tools/view/panels/CameraModel.h"
#include "tools/view/ui/ImGuiVersions.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <set>
#include <thread>

namespace filament_core {
namespace {

using test::PanelStage;
using test::pixelsOf;
using view::Document;

/// With FILAMENT_PANEL_PICTURES the images are kept there, to be looked at.
void keep(Image const& image, std::string const& name) {
    if (const char* folder = std::getenv("FILAMENT_PANEL_PICTURES")) {
        EXPECT_TRUE(savePng(std::filesystem::path(folder) / (name + ".png"), image));
    }
}

size_t coloursOf(Image const& image, uint2 least, uint2 most) {
    std::set<uint32_t> colours;
    for (uint32_t y = least.y; y < most.y; ++y) {
        for (uint32_t x = least.x; x < most.x; ++x) {
            uint32_t colour = 0;
            std::memcpy(&colour, image.pixels.data() + (size_t{ y } * image.width + x) * 4, 4);
            colours.insert(colour);
        }
    }
    return colours.size();
}

/// What panels show that no two runs share: times. Everything else is the same on both APIs.
bool showsTimes(std::string_view panel) {
    return panel == "Timeline" || panel == "Numbers" || panel == "Options" || panel == "Demand" || panel == "Graph";
}

Image pictureOf(PanelStage& stage, std::string_view panel) {
    stage.open(panel);
    stage.panels.state.selectedNode = 1;
    stage.panels.state.selectedMaterial = "canvas";
    stage.panels.state.selectedLight = view::LightSelection{ false, 0 };
    if (stage.document.probes.empty()) addProbe(stage.document, stage.stage->bounds());
    stage.panels.state.selectedProbe = 0;
    if (stage.document.paths.empty())
        addKey(shownPath(stage.document, stage.panels.state.path), stage.panels.state.path, stage.document.view.camera);
    for (int i = 0; i < 3; ++i) stage.frame();
    return stage.read();
}

TEST(Panels, EachIsDrawnAndTheSameOnBothApis) {
    PanelStage vulkan(Backend::Vulkan), gles(Backend::Gles);
    for (const std::string_view panel : view::panelNames()) {
        std::vector<Image> images;
        for (PanelStage* stage : { &vulkan, &gles }) {
            ImGui::SetCurrentContext(stage->context.get());
            images.push_back(pictureOf(*stage, panel));
        }
        keep(images[0], std::string(panel));
        keep(images[1], std::string(panel) + " gles");
        const view::PanelLayout layout = vulkan.panels.layout();
        EXPECT_GT(coloursOf(images[0], { 0, 0 }, uint2(layout.left.size)), 15u) << panel;
        EXPECT_GT(coloursOf(images[0], uint2(layout.right.position), uint2(layout.right.end())), 15u) << panel;
        EXPECT_GT(coloursOf(images[0], uint2(layout.picture.position), uint2(layout.picture.end())), 1u)
                << panel << ": the model is seen between the columns";
        if (!showsTimes(panel)) {
            EXPECT_EQ(images[0].pixels, images[1].pixels) << panel;
        }
    }
}

TEST(Panels, WithTheirTimesFixedEvenThoseAreTheSame) {
    // The same draw data, drawn by both: what an interface shows does not matter for its bits.
    PanelStage stage(Backend::Vulkan);
    auto other = test::makeEngine(Backend::Gles);
    ASSERT_TRUE(other);
    auto ui = view::UiRenderer::create(*other);
    ASSERT_TRUE(ui);
    Scene scene(*other);
    Renderer renderer(*other);
    const Owned<SwapChain> chain = other->own(other->create(SwapChainDesc{ .size = stage.size }));
    const Owned<SwapChain> bare =
            stage.stage->engine().own(stage.stage->engine().create(SwapChainDesc{ .size = stage.size }));
    Scene nothing(stage.stage->engine());
    Renderer first(stage.stage->engine());
    for (const std::string_view panel : view::panelNames()) {
        pictureOf(stage, panel);
        stage.ui->uploadFonts(stage.context.fonts());
        stage.interfaceFrame();
        first.render(nothing, View{ .size = stage.size }, bare);
        stage.ui->render(*ImGui::GetDrawData(), bare, stage.size);
        const auto expected = first.waitPixels(first.readPixels(bare));
        ui->uploadFonts(stage.context.fonts());
        for (ImDrawList* list : view::drawLists(*ImGui::GetDrawData())) // the identifier of the other atlas
            for (ImDrawCmd& command : list->CmdBuffer)
                view::setTexture(command, view::textureOf(stage.context.fonts()));
        renderer.render(scene, View{ .size = stage.size }, chain);
        ui->render(*ImGui::GetDrawData(), chain, stage.size);
        const auto seen = renderer.waitPixels(renderer.readPixels(chain));
        ASSERT_TRUE(expected && seen);
        EXPECT_GT(coloursOf(*seen, { 0, 0 }, stage.size), 20u) << panel;
        EXPECT_EQ(seen->pixels, expected->pixels) << panel;
    }
    test::expectNoErrors(*other);
}

TEST(Panels, TheListOfKeysIsDrawnOverThePicture) {
    PanelStage stage(Backend::Vulkan);
    stage.frame();
    stage.panels.state.showsShortcuts = true;
    for (int i = 0; i < 3; ++i) stage.frame();
    const Image image = stage.read();
    keep(image, "Shortcuts");
    EXPECT_GT(pixelsOf(image, { 255, 204, 102, 255 }), 1000u) << "the names of keys";
    stage.panels.state.showsShortcuts = stage.panels.state.showsPanels = false;
    for (int i = 0; i < 2; ++i) stage.frame();
    EXPECT_EQ(stage.ui->statistics().draws, 0u) << "without panels the picture is alone";
}

TEST(Panels, TheFileDialogLiesOverThePictureAndTakesTheKeyboard) {
    std::vector<Image> images;
    const std::filesystem::path folder = test::folderOfThisTest() / "models";
    std::filesystem::create_directories(folder / "more");
    for (const char* name : { "bird.glb", "cat.gltf", "room 9.hdr", "room 10.hdr" })
        std::ofstream(folder / name) << name;
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        PanelStage stage(backend);
        ImGui::GetIO().ConfigInputTextCursorBlink = false; // how many frames the folder takes is not always the same
        view::FileDialog& dialog = stage.panels.fileDialog;
        dialog.recent = { "/models/helmet.glb", "/skies/noon.hdr" };
        dialog.open(view::FilePurpose::Open);
        dialog.goTo(folder);
        while (dialog.isReading()) stage.interfaceFrame();
        for (int i = 0; i < 3; ++i) stage.frame();
        images.push_back(stage.read());
        EXPECT_TRUE(ImGui::GetIO().WantTextInput);
        const uint2 middle = stage.size / 2u;
        EXPECT_GT(coloursOf(images.back(), middle - uint2(200, 150), middle + uint2(200, 150)), 5u);
    }
    keep(images[0], "Files");
    EXPECT_EQ(images[0].pixels, images[1].pixels);
}

/// A place on each widget that the mouse can find in a column, in the order of rows.
std::vector<ImVec2> widgetsOf(PanelStage& stage, view::PanelRect const& column) {
    std::vector<ImVec2> places;
    std::set<ImGuiID> known;
    for (float y = column.position.y + 4; y < column.end().y; y += 10) {
        for (float x = column.position.x + 6; x < column.end().x; x += 18) {
            ImGui::GetIO().MousePos = { x, y };
            stage.interfaceFrame();
            const ImGuiID hovered = ImGui::GetCurrentContext()->HoveredId;
            if (hovered != 0 && known.insert(hovered).second) places.emplace_back(x, y);
        }
    }
    return places;
}

struct Clicked {
    ImVec2 place{};
    Document document{};
};

/// What a click on each widget of a panel makes of the document, each time from the beginning. Popups are closed. From
/// the bottom: a header that was closed stays so.
std::vector<Clicked> clicksOn(PanelStage& stage, std::string_view panel, view::PanelRect const& column) {
    stage.open(panel);
    const Document before = stage.document;
    const view::PanelState state = stage.panels.state;
    std::vector<Clicked> results;
    std::vector<ImVec2> places = widgetsOf(stage, column);
    std::ranges::reverse(places);
    for (const ImVec2 place : places) {
        stage.click(place);
        EXPECT_TRUE(check(stage.document)) << panel << " at " << place.x << ' ' << place.y;
        results.push_back({ place, stage.document });
        stage.document = before;
        stage.panels.state = state;
        ImGui::ClosePopupsOverWindow(nullptr, false);
        ImGui::ClearActiveID();
        stage.open(panel);
    }
    return results;
}

bool hasDocument(std::vector<Clicked> const& clicks, Document const& document) {
    return std::ranges::any_of(clicks, [&](Clicked const& click) { return click.document == document; });
}

TEST(Panels, ClicksInTheSceneTreeHideNodes) {
    PanelStage stage(Backend::Vulkan);
    stage.open("Scene");
    const std::vector<Clicked> clicks = clicksOn(stage, "Scene", stage.panels.layout().left);
    for (uint32_t node = 0; node < 4; ++node) {
        Document expected = stage.document;
        toggleVisible(expected, node);
        EXPECT_TRUE(hasDocument(clicks, expected)) << node;
    }
}

TEST(Panels, ClicksInOptionsSwitchEffects) {
    PanelStage stage(Backend::Vulkan);
    stage.panels.state.optionFilter = "bloom";
    stage.open("Options");
    const std::vector<Clicked> clicks = clicksOn(stage, "Options", stage.panels.layout().right);
    Document expected = stage.document;
    expected.view.effects.bloom.enabled = true;
    EXPECT_TRUE(hasDocument(clicks, expected));
}

TEST(Panels, EveryWidgetLeavesADocumentThatIsValid) {
    PanelStage stage(Backend::Vulkan);
    stage.panels.state.selectedNode = 1;
    stage.panels.state.selectedMaterial = "canvas";
    stage.panels.state.selectedLight = view::LightSelection{ false, 0 };
    addBookmark(stage.document);
    for (int i = 0; i < 3; ++i)
        addKey(shownPath(stage.document, stage.panels.state.path), stage.panels.state.path, stage.document.view.camera);
    stage.frame();
    size_t widgets = 0, edits = 0;
    const std::vector<std::string_view> names = view::panelNames();
    const auto firstOfRight = std::ranges::find(names, "Camera") - names.begin();
    for (size_t i = 0; i < names.size(); ++i) {
        const view::PanelRect column =
                static_cast<ptrdiff_t>(i) < firstOfRight ? stage.panels.layout().left : stage.panels.layout().right;
        const Document before = stage.document;
        for (Clicked const& click : clicksOn(stage, names[i], column)) {
            ++widgets;
            edits += !(click.document == before);
        }
    }
    EXPECT_GT(widgets, 150u);
    EXPECT_GT(edits, 30u);
}

TEST(Panels, TypingFiltersTheOptions) {
    PanelStage stage(Backend::Vulkan);
    stage.open("Options");
    const view::PanelRect column = stage.panels.layout().right;
    std::string typed;
    for (const ImVec2 place : widgetsOf(stage, column)) {
        if (place.y < 30) continue; // tabs
        stage.click(place);
        if (!ImGui::GetIO().WantTextInput) continue;
        stage.type("Fog.den");
        typed = stage.panels.state.optionFilter;
        break;
    }
    EXPECT_EQ(typed, "Fog.den");
}

TEST(Panels, TypingAPathGivesATextureAPicture) {
    PanelStage stage(Backend::Vulkan);
    stage.panels.state.selectedMaterial = "canvas";
    stage.open("Materials");
    view::prepareKeys(ImGui::GetIO());
    for (const ImVec2 place : widgetsOf(stage, stage.panels.layout().left)) {
        if (place.y < 60) continue; // tabs, and the filter
        stage.click(place);
        if (!ImGui::GetIO().WantTextInput) continue;
        stage.type("cloth.png");
        view::setKey(ImGui::GetIO(), ImGuiKey_Enter, true);
        stage.interfaceFrame();
        view::setKey(ImGui::GetIO(), ImGuiKey_Enter, false);
        stage.interfaceFrame();
        if (!stage.document.textures.empty()) break;
        ImGui::ClearActiveID();
    }
    ASSERT_EQ(stage.document.textures.size(), 1u);
    EXPECT_EQ(stage.document.textures.front().material, "canvas");
    EXPECT_EQ(stage.document.textures.front().file, "cloth.png");
    const auto files = stage.document.textures;
    stage.interfaceFrame();
    EXPECT_EQ(stage.document.textures, files) << "only Enter changes it";
}

TEST(Panels, TheCostOfAMaterialIsCompiledWhenItIsSeen) {
    PanelStage stage(Backend::Vulkan);
    stage.open("Materials");
    stage.document.model.file = test::folderOfThisTest() / "a.mat";
    std::ofstream(stage.document.model.file)
            << "material { name : a, shadingModel : unlit }\n"
               "fragment { void material(inout MaterialInputs material) { prepareMaterial(material); } }";
    stage.stage->apply(stage.document);
    stage.stage->finishLoading();
    stage.stage->poll();
    ASSERT_EQ(stage.stage->shownFile(), stage.document.model.file);
    ASSERT_EQ(stage.stage->materials().size(), 1u);
    const std::string material = stage.stage->materials().front().name;
    stage.panels.state.selectedMaterial = material;
    for (int i = 0; i < 3; ++i) stage.interfaceFrame();
    EXPECT_FALSE(stage.panels.isCompiling()) << "folded";
    for (const ImVec2 place : widgetsOf(stage, stage.panels.layout().left)) {
        if (place.y < 60) continue; // tabs, and the filter
        stage.panels.state.selectedMaterial = material;
        stage.click(place);
        if (stage.panels.isCompiling()) break;
    }
    ASSERT_TRUE(stage.panels.isCompiling()) << "no header of costs was found";
    while (!stage.panels.poll()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_FALSE(stage.panels.poll()) << "once";
    stage.interfaceFrame();
    EXPECT_FALSE(stage.panels.isCompiling()) << "the file has not changed";
}

TEST(Panels, WorkAtAnySizeAndScale) {
    for (const float scale : { 1.0f, 2.0f }) {
        for (const uint2 size : { uint2(1, 1), uint2(200, 100), uint2(640, 360), uint2(1920, 1080) }) {
            PanelStage stage(Backend::Null, size);
            if (stage.context.setScale(scale)) stage.ui->uploadFonts(stage.context.fonts());
            for (const std::string_view panel : view::panelNames()) {
                stage.open(panel);
                stage.frame();
            }
            EXPECT_TRUE(stage.panels.state.opensPanel.empty() || size.x < 600) << "every panel was found";
        }
    }
}

} // namespace
} // namespace filament_core
