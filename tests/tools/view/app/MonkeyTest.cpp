// SPDX-License-Identifier: Apache-2.0
// Random input: keys, clicks, drags, text, files, sizes and pauses at random, for 5 s, and for minutes with
// FILAMENT_STRESS. Nothing ends the process, Vulkan's validation has nothing to say, and afterwards it still draws.
#include "tests/base/ScopedVariable.h"
#include "tests/tools/view/app/HeadlessViewer.h"

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string_view>
#include <vector>

#include <unistd.h>

namespace filament_core::view {
namespace {

namespace fs = std::filesystem;

/// A folder of its own, to which programs write what they keep, with files that can be dropped.
class MonkeyCage {
public:
    MonkeyCage()
            : mFolder(fs::path(testing::TempDir()) / ("monkey" + std::to_string(::getpid()))),
              mBefore(fs::current_path()) {
        fs::create_directories(mFolder / "folder");
        fs::current_path(mFolder);
        std::ofstream(mFolder / "broken.glb") << "glTF, or not";
        std::ofstream(mFolder / "empty.hdr");
        std::ofstream(mFolder / "half.json") << "{ \"view\": { \"size\": [ 64";
        std::ofstream(mFolder / "plain.mat") << "material { shadingModel : unlit }\nfragment { void material(inout "
                                                "MaterialInputs material) { prepareMaterial(material); } }";
        std::ofstream(mFolder / "wrong.mat") << "material { shadingModel : litt }";
        files = { mFolder / "broken.glb", mFolder / "empty.hdr", mFolder / "half.json",
                  mFolder / "plain.mat",  mFolder / "wrong.mat", mFolder / "folder",
                  mFolder / "none.gltf",  showcaseFiles().model, showcaseFiles().environment };
    }
    ~MonkeyCage() {
        fs::current_path(mBefore);
        std::error_code ignored;
        fs::remove_all(mFolder, ignored);
    }
    MonkeyCage(MonkeyCage const&) = delete;
    MonkeyCage& operator=(MonkeyCage const&) = delete;

    fs::path const& folder() const { return mFolder; }
    std::vector<fs::path> files;

private:
    fs::path mFolder, mBefore;
};

class Monkey {
public:
    Monkey(uint32_t seed, MonkeyCage const& cage) : mRandom(seed), mCage(cage) {}

    /// One movement of the hands, and what time passes.
    void act(Viewer& viewer) {
        switch (below(16)) {
        case 0:
        case 1:
        case 2:
            click(viewer);
            break;
        case 3:
        case 4:
            drag(viewer);
            break;
        case 5:
            viewer.handle(ScrollEvent{ { number(-3, 3), number(-3, 3) }, modifiers() });
            break;
        case 6:
        case 7:
        case 8:
        case 9:
            press(viewer, key(), modifiers());
            break;
        case 10:
        case 11:
            type(viewer);
            break;
        case 12:
            viewer.handle(DropEvent{ { mCage.files[below(mCage.files.size())] } });
            break;
        case 13:
            resize(viewer);
            break;
        case 14:
            viewer.handle(FocusEvent{ below(2) == 0 });
            break;
        default:
            press(viewer, kEscape, {});
            break;
        }
        for (uint32_t steps = below(4); steps > 0; --steps) viewer.step(number(0, 0.1f));
    }

private:
    uint32_t below(size_t count) { return static_cast<uint32_t>(mRandom() % count); }
    float number(float low, float high) { return std::uniform_real_distribution(low, high)(mRandom); }
    Modifiers modifiers() {
        if (below(2) == 0) return {};
        return { below(2) == 0, below(2) == 0, below(4) == 0, false };
    }
    /// Of GLFW: what writes, and what does not.
    int key() { return static_cast<int>(below(3) == 0 ? 256 + below(93) : 32 + below(65)); }
    float2 place() { return { number(-5, mPixels.x + 5), number(-5, mPixels.y + 5) }; }
    static void press(Viewer& viewer, int key, Modifiers modifiers) {
        viewer.handle(KeyEvent{ key, true, modifiers });
        viewer.step(0.01);
        viewer.handle(KeyEvent{ key, false, {} });
    }
    void click(Viewer& viewer) {
        const auto button = static_cast<MouseButton>(below(8) == 0 ? 1 + below(2) : 0);
        viewer.handle(MouseMoveEvent{ place() });
        viewer.step(0.01);
        for (uint32_t times = 1 + below(2); times > 0; --times) {
            viewer.handle(MouseButtonEvent{ button, true, modifiers() });
            viewer.step(0.01);
            viewer.handle(MouseButtonEvent{ button, false, {} });
            viewer.step(0.01);
        }
    }
    void drag(Viewer& viewer) {
        const auto button = static_cast<MouseButton>(below(3));
        viewer.handle(MouseMoveEvent{ place() });
        viewer.handle(MouseButtonEvent{ button, true, modifiers() });
        for (uint32_t moves = below(4); moves > 0; --moves) {
            viewer.handle(MouseMoveEvent{ place() });
            viewer.step(0.01);
        }
        if (below(8) != 0) viewer.handle(MouseButtonEvent{ button, false, {} });
    }
    void type(Viewer& viewer) {
        constexpr std::u32string_view kLetters = U"0123456789.-e,abcXYZ #ä\u2028\U0001F600";
        for (uint32_t letters = 1 + below(6); letters > 0; --letters)
            viewer.handle(TextEvent{ kLetters[below(kLetters.size())] });
    }
    void resize(Viewer& viewer) {
        constexpr std::array<uint2, 6> kSizes{
            uint2(0), uint2(1), { 64, 300 }, { 320, 200 }, { 640, 360 }, { 900, 40 }
        };
        const uint2 size = kSizes[below(kSizes.size())];
        viewer.handle(ResizeEvent{ size, below(4) == 0 ? 2.0f : 1.0f });
        mPixels = glm::max(float2(size), float2(1));
    }

    std::mt19937 mRandom;
    MonkeyCage const& mCage;
    float2 mPixels{ kPictureSize };
};

class MonkeyTest : public testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Apis, MonkeyTest, testing::Values(Backend::Vulkan, Backend::Gles),
                         [](auto const& each) { return std::string(toString(each.param)); });

TEST_P(MonkeyTest, FindsNothingThatEndsTheViewer) {
    const MonkeyCage cage;
    const test::ScopedVariable state("XDG_STATE_HOME", cage.folder().string());
    ViewerOptions options = testOptions(GetParam());
    options.out = cage.folder();
    const bool isStress = std::getenv("FILAMENT_STRESS") != nullptr;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(isStress ? 240 : 5);
    for (uint32_t seed = 1; std::chrono::steady_clock::now() < end; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Monkey monkey(seed, cage);
        Headless headless(options);
        ASSERT_TRUE(headless.viewer);
        for (int i = 0; i < 200 && !headless.viewer->isClosed() && std::chrono::steady_clock::now() < end; ++i)
            monkey.act(*headless.viewer);
        if (headless.viewer->isClosed()) continue;
        headless.viewer->handle(ResizeEvent{ kPictureSize, 1 });
        EXPECT_TRUE(headless.stepUntil([&] { return !headless.viewer->isLoading(); }));
        headless.viewer->step(0.1); // it may play an animation, trace an image or measure: then it never settles
        const Result<Image> picture = headless.viewer->screenshot();
        EXPECT_TRUE(picture && picture->width == kPictureSize.x && !picture->pixels.empty());
        for (std::string const& message : headless.viewer->takeMessages())
            EXPECT_EQ(message.find("VUID"), std::string::npos) << message;
    }
}

} // namespace
} // namespace filament_core::view
