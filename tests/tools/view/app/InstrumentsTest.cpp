// SPDX-License-Identifier: Apache-2.0
// What the viewer measures beside its image: injected defects are seen and where, jobs of threads, costs of settings.
#include "tests/tools/view/app/HeadlessViewer.h"
#include "toolkit/mutations/Mutations.h"
#include "tools/view/app/ApiPicture.h"
#include "tools/view/app/Defects.h"
#include "tools/view/compare/Comparison.h"

#include <filament_core/JobTimeline.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <map>
#include <set>

namespace filament_core::view {
namespace {

class InstrumentsTest : public testing::TestWithParam<Backend> {};
INSTANTIATE_TEST_SUITE_P(Apis, InstrumentsTest, testing::Values(Backend::Vulkan, Backend::Gles),
                         [](auto const& api) { return std::string(toString(api.param)); });

Backend otherThan(Backend backend) { return backend == Backend::Vulkan ? Backend::Gles : Backend::Vulkan; }

// ---- defects

/// The document on an engine with the defect.
Image drawWith(Document const& document, Backend backend, std::string_view defect) {
    auto source = ApiPicture::create(backend, { .workers = 1, .validation = true }, defect);
    EXPECT_TRUE(source);
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(5);
    while (source && !(*source)->picture() && std::chrono::steady_clock::now() < end) {
        (*source)->follow(document, 1);
        letOthersWork();
    }
    EXPECT_TRUE(source && (*source)->picture()) << defect;
    return source && (*source)->picture() ? (*source)->picture()->image : Image{};
}

/// Which pixels differ.
std::vector<bool> differing(Image const& a, Image const& b) {
    std::vector<bool> pixels(size_t{ a.width } * a.height);
    for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = std::memcmp(&a.pixels[4 * i], &b.pixels[4 * i], 4) != 0;
    return pixels;
}

/// Where a defect is seen in the showcase with a vignette.
enum class Place : uint8_t {
    Nowhere,  ///< the scene has nothing that it concerns
    Surfaces, ///< somewhere where the model is, and nowhere else
    Border,   ///< not in the middle of the image
    Anywhere,
};

std::map<std::string_view, Place> const& expectedPlaces() {
    static const std::map<std::string_view, Place> places{
        { "roughness", Place::Surfaces },   { "srgb", Place::Surfaces },       { "lightOff", Place::Surfaces },
        { "mipBias", Place::Surfaces },     { "lastMip", Place::Surfaces },    { "depthCompare", Place::Surfaces },
        { "cullFace", Place::Surfaces },    { "blendOff", Place::Surfaces },   { "wrapMode", Place::Surfaces },
        { "metallic", Place::Surfaces },    { "emissive", Place::Surfaces },   { "cutoff", Place::Surfaces },
        { "shadowShift", Place::Surfaces }, { "vignetteOff", Place::Border },  { "exposureOff", Place::Anywhere },
        { "outputSpace", Place::Anywhere }, { "bloomLevels", Place::Nowhere }, { "fogDensity", Place::Nowhere },
        { "profileTurn", Place::Nowhere },
    };
    return places;
}

/// The middle third, both ways.
bool isInMiddle(size_t pixel) {
    const uint32_t x = static_cast<uint32_t>(pixel) % kSmallPicture.x,
                   y = static_cast<uint32_t>(pixel) / kSmallPicture.x;
    return 3 * x >= kSmallPicture.x && 3 * x < 2 * kSmallPicture.x && 3 * y >= kSmallPicture.y &&
           3 * y < 2 * kSmallPicture.y;
}

void expectPlace(std::string const& defect, Place place, std::vector<bool> const& pixels,
                 std::vector<bool> const& isModel) {
    size_t differing = 0, beside = 0;
    for (size_t i = 0; i < pixels.size(); ++i) {
        differing += pixels[i];
        beside += pixels[i] && ((place == Place::Surfaces && !isModel[i]) || (place == Place::Border && isInMiddle(i)));
    }
    EXPECT_EQ(differing > 0, place != Place::Nowhere) << defect;
    EXPECT_EQ(beside, 0u) << defect << ": pixels where it cannot be";
}

/// Black where the images are equal, and nowhere else.
void expectMapOf(Image const& a, Image const& b, std::vector<bool> const& pixels) {
    const Result<Image> map = differenceMap(a, b);
    ASSERT_TRUE(map);
    for (size_t i = 0; i < pixels.size(); ++i) {
        const bool isMarked = map->pixels[4 * i] != std::byte{} || map->pixels[4 * i + 1] != std::byte{} ||
                              map->pixels[4 * i + 2] != std::byte{};
        ASSERT_EQ(isMarked, pixels[i]) << "pixel " << i;
    }
}

/// All that the scene shows, on an engine of the backend, against a clean image of the other one.
void expectDefectsOn(Backend backend, std::function<bool(std::string_view)> const& isAskedFor) {
    Document document = showcaseDocument(kSmallPicture);
    document.view.effects.vignette.enabled = true;
    const Image clean = drawWith(document, otherThan(backend), "");
    EXPECT_EQ(compareImages(clean, drawWith(document, backend, ""))->percentage(), "100.0000 %");
    Document empty = document;
    empty.model.file.clear();
    const std::vector<bool> isModel = differing(clean, drawWith(empty, otherThan(backend), ""));
    for (OfferedDefect const& defect : defectsFor(backend)) {
        const auto place = expectedPlaces().find(defect.name);
        if (place == expectedPlaces().end() || !isAskedFor(defect.name)) continue;
        const Image image = drawWith(document, backend, defect.name);
        const std::vector<bool> pixels = differing(clean, image);
        EXPECT_EQ(compareImages(clean, image)->percentage() == "100.0000 %", place->second == Place::Nowhere)
                << defect.name;
        expectPlace(defect.name, place->second, pixels, isModel);
        expectMapOf(clean, image, pixels);
    }
}

TEST(Defects, AreSeenWhereTheSceneHasWhatTheyConcern) {
    expectDefectsOn(Backend::Gles, [](std::string_view) { return true; });
}

TEST(Defects, OfTheOtherApiAreSeenAsWell) {
    expectDefectsOn(Backend::Vulkan, [](std::string_view name) { return name == "mipBias" || name == "lightOff"; });
}

TEST(Defects, AreThoseOfTheSuiteThatFitTheApi) {
    std::set<std::string_view> offered;
    for (const Backend backend : { Backend::Vulkan, Backend::Gles })
        for (OfferedDefect const& defect : defectsFor(backend)) {
            offered.insert(tools::findMutation(defect.name)->name);
            EXPECT_NE(injected(defect.name), nullptr);
            EXPECT_EQ(whatOf(defect.name), defect.what);
        }
    EXPECT_EQ(offered.size() + 2, tools::mutations().size()) << "all but the two controls";
    for (auto const& [name, place] : expectedPlaces()) EXPECT_TRUE(offered.contains(name)) << name;
    EXPECT_EQ(injected(""), nullptr);
}

TEST_P(InstrumentsTest, AnInjectedDefectIsSeenAndGoesAgain) {
    Headless headless(GetParam(), kSmallPicture);
    if (!headless.viewer) return;
    headless.settle();
    Viewer& viewer = *headless.viewer;
    EXPECT_EQ(viewer.panels().inputs.defects.size(), defectsFor(otherThan(GetParam())).size());
    const std::string before = toJson(viewer.document());
    const auto inject = [&](std::string_view defect) {
        viewer.panels().state.injectedDefect = defect;
        viewer.redraw();
        headless.settle();
        return viewer.compared().result() ? viewer.compared().result()->percentage() : "no result";
    };
    EXPECT_EQ(inject(""), "no result") << "off by default, and nothing is compared";
    EXPECT_LT(std::stod(inject("lightOff")), 99) << "it turns the comparison on";
    EXPECT_EQ(viewer.compared().mode, CompareMode::Difference);
    EXPECT_TRUE(viewer.compared().isDefective());
    EXPECT_TRUE(viewer.panels().inputs.isDefectActive);
    EXPECT_EQ(toJson(viewer.document()), before) << "documents do not have it";
    EXPECT_EQ(inject(""), "100.0000 %");
    EXPECT_FALSE(viewer.compared().isDefective());
    EXPECT_LT(std::stod(inject("roughness")), 100);
    viewer.perform(Action::ChangeBackend);
    headless.settle();
    EXPECT_EQ(viewer.panels().state.injectedDefect, "") << "the other API has become this one";
    EXPECT_THAT(viewer.takeMessages(), testing::IsEmpty());
}

// ---- jobs

TEST_P(InstrumentsTest, TheTimelineShowsWhatThreadsDo) {
    Headless headless(GetParam());
    if (!headless.viewer) return;
    headless.settle();
    Viewer& viewer = *headless.viewer;
    PanelState& state = viewer.panels().state;
    state.opensPanel = "Timeline";
    viewer.redraw();
    headless.settle();
    EXPECT_TRUE(jobTimeline(viewer.stage().engine(), 1e9).empty()) << "nothing is recorded by itself";
    const auto names = [&] {
        std::set<std::string> threads;
        for (JobLane const& lane : viewer.panels().inputs.jobs.lanes) threads.insert(lane.name);
        return threads;
    };
    state.recordsJobs = true;
    viewer.redraw();
    ASSERT_TRUE(headless.stepUntil([&] { return !viewer.isLoading() && !viewer.panels().inputs.jobs.isEmpty(); }));
    headless.settle();
    EXPECT_THAT(names(), testing::IsSupersetOf({ "app thread", "driver thread" }));
    std::set<std::string> jobs;
    for (JobLane const& lane : viewer.panels().inputs.jobs.lanes)
        for (JobBar const& bar : lane.bars) jobs.insert(bar.name);
    EXPECT_THAT(jobs, testing::IsSupersetOf({ "prepare frame", "record frame", "replay frame", "cull" }));
    std::set<std::string> threads;
    for (JobTrack const& track : jobTimeline(viewer.stage().engine(), 1e9)) threads.insert(track.name);
    EXPECT_THAT(threads, testing::Contains("worker bg 0")) << "files are decoded there";
    for (int i = 0; i < 50; ++i) viewer.step(0.01);
    EXPECT_FALSE(viewer.step(0.01)) << "a reading does not lead to the next one";
    state.recordsJobs = false;
    viewer.redraw();
    headless.settle();
    EXPECT_TRUE(jobTimeline(viewer.stage().engine(), 1e9).empty());
    EXPECT_TRUE(viewer.panels().inputs.jobs.isEmpty());
    EXPECT_THAT(viewer.takeMessages(), testing::IsEmpty());
}

// ---- costs

TEST_P(InstrumentsTest, CostsAreMeasuredWhileTheViewerGoesOn) {
    Headless headless(GetParam(), { 96, 54 });
    if (!headless.viewer) return;
    headless.settle();
    Viewer& viewer = *headless.viewer;
    CostPlot const& costs = viewer.panels().inputs.costs;
    const Quality before = viewer.document().view.quality;
    viewer.panels().requests.measuresCosts = true;
    viewer.redraw();
    constexpr std::chrono::minutes kLong(5); // the most exact setting compiles for a while
    ASSERT_TRUE(headless.stepUntil([&] { return costs.points.size() > 1 && costs.points[1].isMeasured(); }, kLong));
    EXPECT_TRUE(costs.isBusy());
    EXPECT_EQ(viewer.document().view.quality, before) << "the document is not measured itself";
    viewer.document().view.quality = costs.points[1].setting.quality;
    viewer.panels().requests.cancelsCosts = true;
    viewer.redraw();
    ASSERT_TRUE(headless.stepUntil([&] { return costs.state == CostPlot::State::Cancelled; }, kLong));
    EXPECT_TRUE(costs.points[1].isMeasured()) << "what is known stays";
    EXPECT_FALSE(viewer.panels().inputs.isCostOfOther) << "another quality is one of the points";
    headless.press('Z', { .control = true });
    headless.settle();
    EXPECT_EQ(viewer.document().view.quality, before);
    viewer.document().view.camera.worldFromView[3] += double4(0.1, 0, 0, 0);
    viewer.redraw();
    headless.settle();
    EXPECT_TRUE(viewer.panels().inputs.isCostOfOther);
    EXPECT_THAT(viewer.takeMessages(), testing::IsEmpty());
}

} // namespace
} // namespace filament_core::view
