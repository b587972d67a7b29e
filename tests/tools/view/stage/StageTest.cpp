// SPDX-License-Identifier: Apache-2.0
#include "tools/view/stage/Stage.h"
#include "tests/tools/view/stage/StageFiles.h"
#include "toolkit/materials/MaterialFile.h"
#include "toolkit/paths/Paths.h"

#include <glm/ext/matrix_transform.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <functional>
#include <map>
#include <random>
#include <thread>

namespace filament_core::view {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

StageFolder& folder() {
    static StageFolder files;
    return files;
}

std::unique_ptr<Stage> makeStage(Backend backend, bool watchesFiles = false) {
    Result<std::unique_ptr<Stage>> stage = Stage::create(
            { .engine = { .backend = backend, .workers = 1, .validation = true, .cacheDirectory = folder() / "cache" },
              .watchesFiles = watchesFiles });
    EXPECT_TRUE(stage.ok()) << stage.error().message;
    return stage ? std::move(*stage) : nullptr;
}

/// The car, from its front.
Document carDocument() {
    Document document;
    document.model.file = folder() / "car.gltf";
    document.environment.file = folder() / "day.hdr";
    document.environment.options = { .faceSize = 16, .samples = 16 };
    document.view.size = { 64, 48 };
    document.view.camera = Camera::lookAt({ 0.2, 0.3, 1.4 }, { 0, 0, 0 });
    document.view.quality.shadows = ShadowFilter::Off;
    return document;
}

Image shoot(Stage& stage) {
    stage.forgetFrames();
    Result<Image> image = stage.renderToImage();
    EXPECT_TRUE(image.ok()) << image.error().message;
    return image ? std::move(*image) : Image{};
}

Image shoot(Stage& stage, Document const& document) {
    stage.apply(document);
    stage.finishLoading();
    EXPECT_THAT(stage.takeMessages(), IsEmpty());
    return shoot(stage);
}

bool isSame(Image const& a, Image const& b) { return a.pixels == b.pixels; }

size_t differentBytes(Image const& a, Image const& b) {
    size_t count = a.pixels.size() == b.pixels.size() ? 0 : a.pixels.size();
    for (size_t i = 0; i < std::min(a.pixels.size(), b.pixels.size()); ++i) count += a.pixels[i] != b.pixels[i];
    return count;
}

/// Documents that differ from each other in everything that a stage applies.
class RandomDocuments {
public:
    explicit RandomDocuments(unsigned seed) : mRandom(seed) {}

    Document next() {
        Document document = carDocument();
        const uint32_t model = pick(7);
        document.model.file = model == 0 ? ""
                                         : folder() / (model == 1  ? "ball.mat"
                                                       : model < 5 ? "car.gltf"
                                                                   : "cab.gltf");
        document.model.fit = pick(4) > 0;
        const uint32_t sky = pick(4);
        document.environment.file = sky == 0 ? "" : folder() / (sky == 1 ? "dusk.hdr" : "day.hdr");
        document.environment.settings = { .illuminance = Lux{ real(5000, 40'000) },
                                          .rotationRadians = real(-3, 3),
                                          .skybox = pick(2) > 0 };
        document.view.camera = Camera::lookAt({ real(-0.5f, 0.5f), real(-0.5f, 0.5f), real(1, 2) }, { 0, 0, 0 });
        document.look = pick(3) == 0 ? folder() / "warm.cube" : "";
        if (model > 1)
            editCar(document);
        else if (model == 1 && pick(2) > 0)
            setParameter(document, "ball", "tint", float3(real(0, 1), real(0, 1), real(0, 1)));
        for (uint32_t lights = pick(4); lights > 0; --lights) addLight(document);
        return document;
    }

private:
    uint32_t pick(uint32_t count) { return static_cast<uint32_t>(mRandom() % count); }
    float real(float low, float high) { return std::uniform_real_distribution<float>(low, high)(mRandom); }

    void editCar(Document& document) {
        if (pick(3) == 0) document.model.variant = "race";
        if (pick(2) > 0) nodeEdit(document, 1).isVisible = false;
        if (pick(2) > 0)
            nodeEdit(document, pick(2)).parentFromNode =
                    glm::rotate(double4x4(1.0), static_cast<double>(real(-1, 1)), double3(0.3, 1, 0.2));
        for (const char* material : { "paint", "skin", "race paint" }) {
            if (pick(3) == 0)
                setParameter(document, material, "baseColorFactor", float4(real(0, 1), real(0, 1), real(0, 1), 1));
            if (pick(3) == 0) setParameter(document, material, "roughnessFactor", real(0.2f, 1));
        }
        for (uint32_t light = 0; light < 3; ++light) {
            if (pick(3) == 0) modelLightEdit(document, light).isOn = false;
            if (pick(3) == 0)
                modelLightEdit(document, light).replacement =
                        PointLight{ .positionWorld = { real(-1, 1), 0, 1 }, .intensity = Candela{ real(10, 900) } };
        }
        if (pick(2) > 0) document.playback = { .animation = 0, .seconds = real(0, 1) };
        if (pick(2) > 0) setMorph(document, pick(2) > 0 ? "smile" : "blink", real(0, 1));
    }
    void addLight(Document& document) {
        const double3 at(real(-1, 1), real(-1, 1), real(0.5f, 2));
        const float3 towards = -float3(at);
        LightDesc light;
        switch (pick(6)) {
        case 0:
            light = SunLight{ .directionWorld = towards, .illuminance = Lux{ real(1000, 20'000) } };
            break;
        case 1:
            light = PointLight{ .positionWorld = at, .intensity = Candela{ real(100, 3000) } };
            break;
        case 2:
            light = SpotLight{ .positionWorld = at,
                               .directionWorld = towards,
                               .intensity = Candela{ real(100, 5000) } };
            break;
        case 3:
            light = RectLight{ .positionWorld = at, .directionWorld = towards, .luminance = Nits{ real(100, 5000) } };
            break;
        case 4:
            light = DiscLight{ .positionWorld = at, .directionWorld = towards, .luminance = Nits{ real(100, 5000) } };
            break;
        default:
            light = TubeLight{ .positionWorld = at, .luminance = Nits{ real(1000, 90'000) } };
        }
        document.lights.push_back({ .isOn = pick(4) > 0, .light = light });
    }

    std::mt19937 mRandom;
};

TEST(StagePictures, DependOnTheLastDocumentAloneAndNotOnTheBackend) {
    constexpr int kRounds = 5, kChanges = 7;
    std::map<Backend, std::vector<Image>> pictures;
    std::vector<Document> lasts;
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        RandomDocuments documents(7);
        const std::unique_ptr<Stage> stage = makeStage(backend);
        ASSERT_TRUE(stage);
        for (int round = 0; round < kRounds; ++round) {
            Document last;
            for (int i = 0; i < kChanges; ++i) {
                last = documents.next();
                stage->apply(last);
                if (i % 3 == 0) stage->finishLoading(); // the others are overtaken while they load
                if (i % 3 == 1) stage->poll();
                ASSERT_TRUE(stage->renderToImage().ok());
            }
            stage->apply(last);
            stage->finishLoading();
            pictures[backend].push_back(shoot(*stage));
            EXPECT_THAT(stage->takeMessages(), IsEmpty());
            if (backend == Backend::Vulkan) lasts.push_back(last);
        }
    }
    for (int round = 0; round < kRounds; ++round) {
        const auto at = static_cast<size_t>(round);
        EXPECT_EQ(differentBytes(pictures[Backend::Vulkan][at], pictures[Backend::Gles][at]), 0u) << round;
        for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
            const std::unique_ptr<Stage> fresh = makeStage(backend);
            EXPECT_EQ(differentBytes(shoot(*fresh, lasts[at]), pictures[backend][at]), 0u)
                    << toString(backend) << ' ' << round;
        }
    }
    EXPECT_FALSE(isSame(pictures[Backend::Vulkan][0], pictures[Backend::Vulkan][1])) << "they show something";
}

class StageTest : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        stage = makeStage(GetParam());
        ASSERT_TRUE(stage);
    }
    std::unique_ptr<Stage> stage;
};

TEST_P(StageTest, ShowsEveryEditAndUndoesIt) {
    const Document plain = carDocument();
    const Image before = shoot(*stage, plain);
    const std::vector<std::pair<const char*, std::function<void(Document&)>>> edits{
        { "hidden", [](Document& d) { nodeEdit(d, 0).isVisible = false; } },
        { "moved", [](Document& d) { nodeEdit(d, 1).parentFromNode = double4x4(0.5); } },
        { "painted", [](Document& d) { setParameter(d, "paint", "baseColorFactor", float4(0, 1, 0, 1)); } },
        { "variant", [](Document& d) { d.model.variant = "race"; } },
        { "not fitted", [](Document& d) { d.model.fit = false; } },
        { "light off", [](Document& d) { modelLightEdit(d, 0).isOn = false; } },
        { "light replaced",
          [](Document& d) {
              modelLightEdit(d, 1).replacement = SunLight{ .directionWorld = { 0, 0, -1 }, .illuminance = Lux{ 9000 } };
          } },
        { "light added",
          [](Document& d) {
              d.lights.push_back({ .light = SunLight{ .directionWorld = { 0, 0, -1 } } });
          } },
        { "animated", [](Document& d) { d.playback = { .animation = 0, .seconds = 0.7 }; } },
        { "morphed", [](Document& d) { setMorph(d, "smile", 1); } },
        { "rotated", [](Document& d) { d.environment.settings.rotationRadians = 1; } },
        { "darker", [](Document& d) { d.environment.settings.illuminance = Lux{ 3000 }; } },
        { "without a sky", [](Document& d) { d.environment.settings.skybox = false; } },
        { "another sky", [](Document& d) { d.environment.file = folder() / "dusk.hdr"; } },
        { "no sky", [](Document& d) { d.environment.file.clear(); } },
        { "exposed", [](Document& d) { d.view.camera.exposure.iso = 400; } },
        { "look", [](Document& d) { d.look = folder() / "warm.cube"; } },
        { "debug view", [](Document& d) { d.view.debugView = DebugView::Lights; } },
        { "another model", [](Document& d) { d.model.file = folder() / "cab.gltf"; } },
        { "no model", [](Document& d) { d.model.file.clear(); } },
    };
    for (auto const& [name, edit] : edits) {
        Document edited = plain;
        edit(edited);
        EXPECT_GT(differentBytes(shoot(*stage, edited), before), 0u) << name;
        EXPECT_EQ(differentBytes(shoot(*stage, plain), before), 0u) << "after " << name;
    }
}

TEST_P(StageTest, SendsNothingForADocumentThatDidNotChange) {
    Document document = carDocument();
    document.playback.animation = 0;
    document.lights.push_back({ .light = SpotLight{ .innerConeRadians = 0.1f } });
    setParameter(document, "paint", "roughnessFactor", 0.5f);
    shoot(*stage, document);
    const Owned<SwapChain> target =
            stage->engine().own(stage->engine().create(SwapChainDesc{ .size = document.view.size }));
    const auto commandsOf = [&](auto const& frame) {
        stage->engine().waitIdle();
        const uint64_t before = stage->engine().statistics().commands;
        frame();
        stage->engine().waitIdle();
        return stage->engine().statistics().commands - before;
    };
    for (int warmUp = 0; warmUp < 8; ++warmUp) stage->render(target);
    const uint64_t alone = commandsOf([&] { stage->render(target); });
    for (int frame = 0; frame < 4; ++frame) {
        EXPECT_EQ(commandsOf([&] {
                      stage->apply(document);
                      stage->poll();
                      stage->render(target);
                  }),
                  alone);
    }
    EXPECT_GT(alone, 0u);
}

TEST_P(StageTest, KeepsWhatWasThereIfALoadFails) {
    const Document good = carDocument();
    const Image before = shoot(*stage, good);
    const uint64_t generation = stage->generation();
    Document bad = good;
    bad.model.file = folder() / "missing.gltf";
    nodeEdit(bad, 0).isVisible = false; // of the model that never comes
    stage->apply(bad);
    stage->finishLoading();
    EXPECT_THAT(stage->takeMessages(), ElementsAre(HasSubstr("missing.gltf")));
    EXPECT_EQ(differentBytes(shoot(*stage), before), 0u);
    EXPECT_EQ(stage->shownFile(), good.model.file);
    EXPECT_EQ(stage->generation(), generation);
    stage->apply(good);
    EXPECT_FALSE(stage->progress().isLoading) << "it is still there";
    EXPECT_EQ(differentBytes(shoot(*stage), before), 0u);
    Document badSky = good;
    badSky.environment.file = folder() / "car.gltf";
    badSky.look = folder() / "car.gltf";
    badSky.dirt = folder() / "car.gltf";
    stage->apply(badSky);
    stage->finishLoading();
    EXPECT_EQ(stage->takeMessages().size(), 3u);
    EXPECT_EQ(differentBytes(shoot(*stage), before), 0u);
}

TEST_P(StageTest, KeepsWhatWasThereWhileAndAfterALoadIsCancelled) {
    const Document car = carDocument();
    const Image before = shoot(*stage, car);
    Document other = car;
    other.model.file = folder() / "ball.mat"; // compiles for a while
    tools::forgetCompiledMaterialFiles();
    other.environment.file = folder() / "dusk.hdr";
    stage->apply(other);
    EXPECT_TRUE(stage->progress().isLoading);
    EXPECT_EQ(stage->progress().files, 2u);
    EXPECT_THAT(stage->progress().what, HasSubstr("ball.mat, compiling"));
    EXPECT_EQ(differentBytes(shoot(*stage), before), 0u);
    stage->cancel();
    EXPECT_FALSE(stage->progress().isLoading);
    stage->apply(other);
    stage->finishLoading();
    EXPECT_EQ(stage->shownFile(), car.model.file);
    EXPECT_THAT(stage->takeMessages(), IsEmpty());
    EXPECT_EQ(differentBytes(shoot(*stage), before), 0u);
    stage->reload();
    stage->finishLoading();
    EXPECT_EQ(stage->shownFile(), other.model.file);
    EXPECT_GT(differentBytes(shoot(*stage), before), 0u);
}

TEST_P(StageTest, RefusesADocumentOutOfRangeOnce) {
    const Document good = carDocument();
    const Image before = shoot(*stage, good);
    Document bad = good;
    bad.view.camera.exposure.iso = -1;
    for (int frame = 0; frame < 3; ++frame) stage->apply(bad);
    EXPECT_THAT(stage->takeMessages(), ElementsAre(HasSubstr("view.camera.exposure.iso")));
    EXPECT_EQ(stage->document(), good);
    EXPECT_EQ(differentBytes(shoot(*stage), before), 0u);
}

TEST_P(StageTest, SaysOnceWhatAnEditCannotFind) {
    Document document = carDocument();
    shoot(*stage, document);
    nodeEdit(document, 99);
    modelLightEdit(document, 3);
    setMorph(document, "smlie", 1);
    setParameter(document, "pain", "baseColorFactor", float4(1));
    setParameter(document, "paint", "roughness", 1.0f);
    setParameter(document, "paint", "roughnessFactor", float4(1));
    document.playback.animation = 4;
    document.model.variant = "rice";
    for (int frame = 0; frame < 3; ++frame) {
        document.playback.seconds += 0.1;
        stage->apply(document);
    }
    EXPECT_THAT(stage->takeMessages(),
                testing::UnorderedElementsAre(
                        HasSubstr("no node 99; the model has 6"), HasSubstr("no light 3; the model has 3"),
                        HasSubstr("'smlie'"), HasSubstr("'pain'"), HasSubstr("'roughness'"),
                        HasSubstr("roughnessFactor"), HasSubstr("no animation 4; the model has 1"), HasSubstr("rice")));
}

TEST_P(StageTest, ListsWhatItShows) {
    Document document = carDocument();
    document.lights = { { .light = SunLight{} }, { .isOn = false, .light = PointLight{} } };
    modelLightEdit(document, 0).isOn = false;
    setParameter(document, "paint", "baseColorFactor", float4(0.1f, 0.2f, 0.3f, 1));
    shoot(*stage, document);
    ASSERT_EQ(stage->nodes().size(), 6u);
    EXPECT_EQ(stage->scene().name(stage->nodes()[1]), "head");
    EXPECT_EQ(stage->indexOf(stage->nodes()[4]), 4u);
    EXPECT_EQ(stage->indexOf(stage->root()), std::nullopt);
    EXPECT_NEAR(stage->nodeOfFile(1)[3].x, 0.6, 1e-6);
    ASSERT_EQ(stage->modelLights().size(), 3u);
    EXPECT_FALSE(stage->modelLights()[0].light);
    EXPECT_TRUE(stage->modelLights()[1].light);
    EXPECT_EQ(stage->modelLights()[0].name, "lamp");
    EXPECT_EQ(std::get<PointLight>(stage->lightOfFile(0)).intensity.value, 300);
    ASSERT_EQ(stage->documentLights().size(), 2u);
    EXPECT_TRUE(stage->documentLights()[0]);
    EXPECT_FALSE(stage->documentLights()[1]);
    EXPECT_FALSE(stage->hasModelEnvironment());
    ASSERT_TRUE(stage->modelCopy());
    EXPECT_EQ(stage->modelCopy()->cameras().size(), 1u);
    bool hasPaint = false;
    for (CopyMaterial const& material : stage->materials()) {
        if (material.name != "paint") continue;
        hasPaint = true;
        EXPECT_EQ(stage->parameter(material.instance, "baseColorFactor").value(),
                  ParameterValue(float4(0.1f, 0.2f, 0.3f, 1)));
        EXPECT_EQ(stage->parameter(material.instance, "metallicFactor").value(), ParameterValue(0.0f));
        EXPECT_EQ(stage->parameter(material.instance, "metalic").error().code, ErrorCode::NotFound);
        EXPECT_EQ(stage->parameter(material.instance, "baseColorMap").error().code, ErrorCode::Unsupported);
    }
    EXPECT_TRUE(hasPaint);
}

TEST_P(StageTest, ShowsAMaterialFileAndItsParameters) {
    Document document = carDocument();
    document.model.file = folder() / "ball.mat";
    const Image before = shoot(*stage, document);
    ASSERT_EQ(stage->materials().size(), 1u);
    EXPECT_EQ(stage->materials()[0].name, "ball");
    EXPECT_EQ(stage->modelCopy(), nullptr);
    setParameter(document, "ball", "tint", float3(0, 1, 0));
    EXPECT_GT(differentBytes(shoot(*stage, document), before), 0u);
    EXPECT_EQ(stage->parameter(stage->materials()[0].instance, "tint").value(), ParameterValue(float3(0, 1, 0)));
    resetParameter(document, "ball", "tint");
    EXPECT_EQ(differentBytes(shoot(*stage, document), before), 0u);
}

TEST_P(StageTest, DoesNotGrowOverSixtyChanges) {
    std::vector<Document> documents;
    RandomDocuments random(3);
    for (int i = 0; i < 10; ++i) documents.push_back(random.next());
    uint64_t bytes = 0;
    for (int round = 0; round < 6; ++round) {
        for (Document const& document : documents) {
            stage->apply(document);
            stage->finishLoading();
            ASSERT_TRUE(stage->renderToImage().ok());
        }
        stage->engine().waitIdle();
        if (round == 2)
            bytes = // pools are as large as they get
                    stage->engine().statistics().deviceBytes;
    }
    EXPECT_EQ(stage->engine().statistics().deviceBytes, bytes);
    EXPECT_THAT(stage->takeMessages(), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Backends, StageTest, testing::Values(Backend::Vulkan, Backend::Gles),
                         [](auto const& each) { return std::string(toString(each.param)); });

/// Polls until the image is another one, or the time is over.
Image nextPicture(Stage& stage, Image const& last) {
    for (int i = 0; i < 300; ++i) {
        stage.poll();
        stage.finishLoading();
        Image picture = shoot(stage);
        if (!isSame(picture, last)) return picture;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    ADD_FAILURE() << "the file was not loaded again";
    return last;
}

TEST(StageFilesTest, AreLoadedAgainWhenTheyChange) {
    const std::unique_ptr<Stage> stage = makeStage(Backend::Vulkan, true);
    ASSERT_TRUE(stage);
    Document document = carDocument();
    document.model.file = folder().write("changing.gltf", carText("0, 0.2, 1"));
    document.look = folder().write("changing.cube", "LUT_1D_SIZE 2\n0 0 0\n1 1 1\n");
    setParameter(document, "skin", "roughnessFactor", 0.3f);
    const Image blue = shoot(*stage, document);
    folder().write("changing.gltf", carText("0.9, 0.1, 0.1"));
    const Image red = nextPicture(*stage, blue);
    EXPECT_GT(differentBytes(red, blue), 20u);
    folder().write("changing.cube", "LUT_1D_SIZE 2\n0 0 0\n0.5 0.5 0.5\n");
    const Image dark = nextPicture(*stage, red);
    EXPECT_THAT(stage->takeMessages(), IsEmpty());

    document.model.file = folder().write("changing.mat", materialText("vec3(1.0)"));
    document.materials.clear();
    const Image plain = shoot(*stage, document);
    folder().write("changing.mat", materialText("vec3(1.0) +"));
    std::vector<std::string> messages;
    for (int i = 0; i < 300 && messages.empty(); ++i) {
        stage->poll();
        stage->finishLoading();
        messages = stage->takeMessages();
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    EXPECT_THAT(messages, ElementsAre(HasSubstr("changing.mat:")));
    EXPECT_EQ(differentBytes(shoot(*stage), plain), 0u) << "the last good one stays";
    folder().write("changing.mat", materialText("vec3(0.2)"));
    EXPECT_GT(differentBytes(nextPicture(*stage, plain), plain), 20u);
    EXPECT_THAT(stage->takeMessages(), IsEmpty());
}

/// Processor time of this thread or of the process: that of other programs does not count.
double processorMilliseconds(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

TEST(StageLoads, LeaveTheAppThreadItsTime) {
    if (tools::assetDir().empty())
        GTEST_SKIP() << "FILAMENT_ASSET_DIR is not set: the models are not beside the checkout";
    const std::filesystem::path model = tools::assetDir() / "models/FlightHelmet/FlightHelmet.gltf";
    const std::unique_ptr<Stage> stage = makeStage(Backend::Vulkan);
    ASSERT_TRUE(stage);
    Document document = carDocument();
    document.model.file = model;
    std::vector<double> slices;
    const auto timed = [&](auto const& work) {
        const double begin = processorMilliseconds(CLOCK_THREAD_CPUTIME_ID);
        work();
        slices.push_back(processorMilliseconds(CLOCK_THREAD_CPUTIME_ID) - begin);
    };
    const double before = processorMilliseconds(CLOCK_PROCESS_CPUTIME_ID);
    timed([&] { stage->apply(document); });
    while (stage->progress().isLoading) {
        timed([&] { stage->poll(); });
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    EXPECT_EQ(stage->shownFile(), model);
    std::ranges::sort(slices, std::greater<>());
    const double whole = processorMilliseconds(CLOCK_PROCESS_CPUTIME_ID) - before;
    std::printf("%zu slices; the longest took %.2f, %.2f, %.2f of %.2f ms\n", slices.size(), slices[0], slices[1],
                slices[2], whole);
    EXPECT_LT(slices[0], whole / 40) << "one of the fifteen textures alone is more of the work";
}

} // namespace
} // namespace filament_core::view
