// SPDX-License-Identifier: Apache-2.0
// lights_bench: what a frame costs with 1, 10, 50, 200, ... lamps of half a metre's range above a floor that fills the
// image, on both APIs. --shapes point rect disc tube profile cookie compares areas, and points with a
//   profile or a cookie, with points: --lamps 1 --range 0.
//   Method  one engine per API; every round draws every number of lamps on each, so that all see the same machine.
//           Milliseconds of a frame from render() until the device is idle; medians of the ratios within rounds.
//   Status  0: measured, table on standard output; 1: the reason in one line.
#include "base/Statistics.h"
#include "toolkit/materials/MaterialStand.h"
#include "toolkit/materials/MaterialTerms.h"
#include "toolkit/program/CommandLine.h"

#include <filament_core/filament_core.h>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <random>

namespace filament_core::bench {
namespace {

struct Options {
    int rounds = 9, frames = 3;
    uint2 size{ 1280, 720 };
    double range = 0.5;
    std::vector<int> lamps{ 0, 1, 10, 50, 200, 1000, 4000 };
    std::vector<std::string> shapes{ "point" };
};

/// What one frame shows.
struct Case {
    std::string shape;
    int lamps = 0;
};

std::vector<Case> casesOf(Options const& options) {
    std::vector<Case> cases;
    for (std::string const& shape : options.shapes) {
        for (const int lamps : options.lamps) cases.push_back({ shape, lamps });
    }
    return cases;
}

constexpr uint32_t kCookieSize = 256;

/// Areas are as bright on the floor as points, from 0.4 metres above it.
void addLamp(Scene& scene, std::string const& shape, LightProfile profile, LightImage cookie, double3 at, float range) {
    const Nits nits{ 40'000 };
    const float3 down{ 0, 0, -1 };
    if (shape == "rect")
        scene.add(RectLight{ .positionWorld = at,
                             .directionWorld = down,
                             .widthMeters = 0.5f,
                             .heightMeters = 0.5f,
                             .luminance = nits,
                             .rangeMeters = range });
    else if (shape == "disc")
        scene.add(DiscLight{ .positionWorld = at,
                             .directionWorld = down,
                             .radiusMeters = 0.28f,
                             .luminance = nits,
                             .rangeMeters = range });
    else if (shape == "tube")
        scene.add(TubeLight{ .positionWorld = at,
                             .lengthMeters = 1,
                             .radiusMeters = 0.12f,
                             .luminance = nits,
                             .rangeMeters = range });
    else
        scene.add(PointLight{ .positionWorld = at,
                              .intensity = Candela{ 10'000 },
                              .rangeMeters = range,
                              .profile = shape == "profile" ? profile : LightProfile{},
                              .cookie = shape == "cookie" ? cookie : LightImage{},
                              .directionWorld = down });
}

/// As bright everywhere, in steps of 5 by 15 degrees.
std::string luminaire() {
    constexpr int kVertical = 37, kHorizontal = 25;
    std::string text =
            fmt::format("IES:LM-63-2019\nTILT=NONE\n1 -1 1 {} {} 1 2 0 0 0\n1 1 9\n", kVertical, kHorizontal);
    for (int i = 0; i < kVertical; ++i) text += fmt::format("{}\n", i * 5);
    for (int i = 0; i < kHorizontal; ++i) text += fmt::format("{}\n", i * 15);
    for (int i = 0; i < kVertical * kHorizontal; ++i) text += "100\n";
    return text;
}

/// One engine, and a scene for each number of lamps.
class Device {
public:
    static Result<std::unique_ptr<Device>> open(Backend backend, Options const& options) {
        Result<Engine> engine = Engine::create({ .backend = backend });
        if (!engine) return engine.error();
        const auto file = tools::readMaterialTerm(tools::materialTerms().front());
        if (!file) return file.error();
        Result<tools::MaterialStand> floor = tools::MaterialStand::make(*engine, **file);
        if (!floor) return floor.error();
        std::unique_ptr<Device> device(new Device(std::move(*engine), std::move(*floor), options));
        const std::string text = luminaire();
        const Result<LightProfile> profile = device->mEngine.create(LightProfileDesc{ std::as_bytes(std::span(text)) });
        if (!profile) return profile.error();
        device->mProfile = device->mEngine.own(*profile);
        const std::vector<uint32_t> white(size_t{ kCookieSize } * kCookieSize, 0xFFFFFFFF);
        const Result<LightImage> cookie =
                device->mEngine.create(LightImageDesc{ .width = kCookieSize,
                                                       .height = kCookieSize,
                                                       .pixels = std::as_bytes(std::span(white)),
                                                       .shape = LightImageShape::Octahedron });
        if (!cookie) return cookie.error();
        device->mCookie = device->mEngine.own(*cookie);
        for (Case const& one : casesOf(options)) device->addScene(one);
        return device;
    }

    /// Milliseconds per frame.
    double measure(size_t scene) {
        using Clock = std::chrono::steady_clock;
        const auto begin = Clock::now();
        for (int i = 0; i < mOptions.frames; ++i) {
            mRenderer.render(*mScenes[scene], mView, mTarget);
            mEngine.waitIdle();
        }
        return std::chrono::duration<double, std::milli>(Clock::now() - begin).count() / mOptions.frames;
    }

    const char* name() const { return toString(mEngine.device().backend); }

private:
    Device(Engine engine, tools::MaterialStand floor, Options const& options)
            : mOptions(options), mEngine(std::move(engine)), mFloor(std::move(floor)), mRenderer(mEngine) {
        mView.camera = Camera::lookAt({ 0, -9, 7 }, { 0, 0.5, 0 }, { .verticalFovDegrees = 50 }, {}, { 0, 0, 1 });
        mView.size = options.size;
        mView.quality.shadows = ShadowFilter::Off; // effects_bench measures them
        mTarget = mEngine.own(mEngine.create(SwapChainDesc{ .size = mView.size, .name = "lights_bench" }));
    }

    // Lamps all over the visible floor; the first one in the middle.
    void addScene(Case const& one) {
        mScenes.push_back(std::make_unique<Scene>(mEngine));
        Scene& scene = *mScenes.back();
        mFloor.addTo(scene,
                     double4x4(double4(80, 0, 0, 0), double4(0, 80, 0, 0), double4(0, 0, 80, 0), double4(0, 0, 0, 1)));
        std::mt19937 random(1);
        const auto next = [&] { return static_cast<double>(random()) / 4294967296.0; };
        for (int i = 0; i < one.lamps; ++i) {
            const double y = i ? -5 + 17 * next() : 0.5, width = 6 + 0.55 * (y + 5);
            const double x = i ? (2 * next() - 1) * width : 0;
            addLamp(scene, one.shape, mProfile, mCookie, { x, y, 0.1 + 0.3 * next() },
                    static_cast<float>(mOptions.range));
        }
        mRenderer.render(scene, mView, mTarget);
        mEngine.waitIdle();
    }

    Options const& mOptions;
    Engine mEngine;
    tools::MaterialStand mFloor;
    std::vector<std::unique_ptr<Scene>> mScenes; // destroyed before the objects that they show
    Owned<LightProfile> mProfile;
    Owned<LightImage> mCookie;
    Owned<SwapChain> mTarget;
    Renderer mRenderer;
    View mView;
};

void print(Device const& device, Options const& options, std::vector<std::vector<double>> const& times) {
    const std::vector<Case> cases = casesOf(options);
    const auto one = std::ranges::find(cases, 1, &Case::lamps); // of the first shape
    for (size_t i = 0; i < cases.size(); ++i) {
        std::vector<double> ratios;
        for (size_t round = 0; one != cases.end() && round < times[i].size(); ++round)
            ratios.push_back(times[i][round] / times[static_cast<size_t>(one - cases.begin())][round]);
        std::printf("| %s | %s | %d | %.1f | %.1f | %.2f |\n", device.name(), cases[i].shape.c_str(), cases[i].lamps,
                    *std::ranges::min_element(times[i]), median(times[i]), ratios.empty() ? 0 : median(ratios));
    }
}

Result<void> run(Options const& options) {
    std::vector<std::unique_ptr<Device>> devices;
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        Result<std::unique_ptr<Device>> device = Device::open(backend, options);
        if (!device) return device.error();
        devices.push_back(std::move(*device));
    }
    std::vector times(devices.size(), std::vector<std::vector<double>>(casesOf(options).size()));
    for (int round = 0; round < options.rounds; ++round) {
        for (size_t d = 0; d < devices.size(); ++d) {
            for (size_t i = 0; i < times[d].size(); ++i) times[d][i].push_back(devices[d]->measure(i));
        }
    }
    std::printf("| API | shape | lamps | minimum ms | median ms | x one lamp |\n|---|---|---|---|---|---|\n");
    for (size_t d = 0; d < devices.size(); ++d) print(*devices[d], options, times[d]);
    return {};
}

} // namespace
} // namespace filament_core::bench

int main(int argc, char** argv) {
    using namespace filament_core;
    bench::Options options;
    filament_core::tools::CommandLine app{ "Frames with many small lamps, beside a frame with one." };
    app.option("--rounds", options.rounds, "rounds; each draws every number of lamps").inRange(1, 1000);
    app.option("--frames", options.frames, "frames a measurement").inRange(1, 1000);
    app.option("--lamps", options.lamps, "numbers of lamps").inRange(0, 100'000);
    app.option("--shapes", options.shapes, "shapes of lamps")
            .oneOf({ "point", "rect", "disc", "tube", "profile", "cookie" });
    app.option("--range", options.range, "metres; 0: unlimited").inRange(0.0, 1e6);
    if (const std::optional<int> status = app.exitStatus(argc, argv)) return *status;
    const Result<void> done = bench::run(options);
    if (!done) std::fprintf(stderr, "lights_bench: error: %s\n", done.error().message.c_str());
    return done ? 0 : 1;
}
