// SPDX-License-Identifier: Apache-2.0
// measureQualityCosts(): draws every value of every choice in turns, timed by the device, and compares the images.
#include "base/Result.h"
#include "base/Statistics.h"
#include "base/Suggest.h"
#include "base/math/Elementary.h"
#include "base/math/Half.h"
#include "filament_core/engine/PublicCall.h"

#include <filament_core/QualityCosts.h>
#include <filament_core/Renderer.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <numeric>

#include <time.h>

namespace filament_core {
namespace {

constexpr uint32_t kFewestRounds = 15; // half of them suffice for a median between least and largest
constexpr uint32_t kAccumulatedFrames = 16, kFramesOfSmoothEdges = 64; // of a static view
constexpr double kDarkest = 0.01;                                      // of the mean: darker values count as this
constexpr double kMostLinear = 65504;                                  // the largest half float

double linearFromHalf(uint16_t half) {
    const auto value = static_cast<double>(floatFromHalf(half));
    return std::isfinite(value) ? std::clamp(value, 0.0, kMostLinear) : kMostLinear;
}

// IEC 61966-2-1.
double linearFromCode(std::byte code) {
    const double c = std::to_integer<int>(code) / 255.0;
    return c <= 0.04045 ? c / 12.92 : elementary::pow((c + 0.055) / 1.055, 2.4);
}

double luminanceAt(Image const& image, size_t pixel) {
    double3 color;
    if (image.format == Format::RGBA16F) {
        uint16_t bits[3];
        std::memcpy(bits, image.pixels.data() + pixel * 8, sizeof(bits));
        color = { linearFromHalf(bits[0]), linearFromHalf(bits[1]), linearFromHalf(bits[2]) };
    } else {
        for (int c = 0; c < 3; ++c) color[c] = linearFromCode(image.pixels[pixel * 4 + static_cast<size_t>(c)]);
    }
    return glm::dot(color, double3(0.2126, 0.7152, 0.0722));
}

double relativeError(Image const& image, Image const& exact) {
    const size_t count = size_t{ exact.width } * exact.height;
    double mean = 0, sum = 0;
    for (size_t i = 0; i < count; ++i) mean += luminanceAt(exact, i) / static_cast<double>(count);
    if (mean <= 0) return 0;
    for (size_t i = 0; i < count; ++i) {
        const double truth = luminanceAt(exact, i);
        const double difference = (luminanceAt(image, i) - truth) / (truth + kDarkest * mean);
        sum += difference * difference;
    }
    return std::min(std::sqrt(sum / static_cast<double>(count)), 100.0);
}

/// The true median lies between this rank from below and the same rank from above with a probability of 99 %: a table
/// has about 60 intervals, and none should be wrong. Conover 1999, "Practical Nonparametric Statistics", section 3.2.
size_t lowRank(size_t count) {
    const auto n = static_cast<double>(count);
    double probability = elementary::pow(0.5, n), below = 0; // for exactly `rank` successes; for fewer
    size_t rank = 0;
    while (below + probability <= 0.005) {
        below += probability;
        probability *= (n - static_cast<double>(rank)) / (static_cast<double>(rank) + 1);
        ++rank;
    }
    return rank > 0 ? rank - 1 : 0;
}

/// Frames of two settings, drawn in turns: the ratios of the rounds whose two times had the smallest sums. Other work
/// on the machine only ever slows a round down, and hits either of the two by chance.
std::vector<double> undisturbedRatios(std::vector<double> const& times, std::vector<double> const& bases) {
    std::vector<size_t> rounds(times.size());
    std::iota(rounds.begin(), rounds.end(), size_t{ 0 });
    std::ranges::sort(rounds, {}, [&](size_t round) { return times[round] + bases[round]; });
    rounds.resize((rounds.size() + 1) / 2);
    std::vector<double> ratios;
    for (const size_t round : rounds) ratios.push_back(times[round] / bases[round]);
    std::ranges::sort(ratios);
    return ratios;
}

/// Of all threads of this process, which include the device of a CPU driver.
double processorMilliseconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

struct FrameCost {
    double device = 0;   // milliseconds by the device's clock
    double compared = 0; // what ratios are computed from
};

struct Setting {
    std::string value;
    Quality timed, pictured;
    std::unique_ptr<Renderer> renderer; // of its own: shadow maps are kept from frame to frame, as they are for users
    std::vector<double> device{}, compared{}; // by round
};

class CostMeter {
public:
    CostMeter(Engine& engine, Scene const& scene, View const& view)
            : mEngine(engine), mScene(scene), mView(view), mDisplay(target(Format::RGBA8)),
              mLinear(target(Format::RGBA16F)), mIsCpu(engine.device().device.find("llvmpipe") != std::string::npos) {}

    Result<QualityEffect> measure(Option const& choice, uint32_t rounds) {
        std::vector<Setting> settings = settingsOf(choice);
        QualityEffect effect{ .name = std::string(choice.name), .values = {} };
        for (Setting& setting : settings) {
            effect.values.push_back({ .value = setting.value });
            const Result<double> error = errorOf(setting.pictured, exactOf(choice.name));
            if (!error) return error.error();
            effect.values.back().error = *error;
            if (const Result<FrameCost> warmUp = time(setting); !warmUp) return warmUp.error();
        }
        for (uint32_t round = 0; round < rounds; ++round) {
            for (size_t i = 0; i < settings.size(); ++i) {
                Setting& setting = settings[(i + round) % settings.size()];
                const Result<FrameCost> cost = time(setting);
                if (!cost) return cost.error();
                setting.device.push_back(cost->device);
                setting.compared.push_back(cost->compared);
            }
        }
        fillTimes(settings, *optionValue(Quality{}, choice.name), effect);
        return effect;
    }

    /// References of errors: the image of the most exact settings, and that image with smooth edges.
    Result<void> drawExact() {
        Quality quality = qualityPreset(QualityPreset::Reference);
        if (const Result<void> drawn = draw(quality, 1, mExact); !drawn) return drawn;
        quality.antiAliasing = AntiAliasing::Taa;
        return draw(quality, kFramesOfSmoothEdges, mSmooth);
    }

private:
    struct Pictures {
        Image linear, display;
    };
    Owned<SwapChain> target(Format format) {
        return mEngine.own(mEngine.create(
                SwapChainDesc{ .size = mView.size, .imageCount = 1, .format = format, .name = "quality costs" }));
    }

    std::vector<Setting> settingsOf(Option const& choice) const {
        std::vector<Setting> settings;
        for (const std::string_view value : choice.values) {
            Setting setting{ std::string(value), mView.quality, qualityPreset(QualityPreset::Reference),
                             std::make_unique<Renderer>(mEngine, RendererOptions{ .passTimers = true }) };
            for (Quality* quality : { &setting.timed, &setting.pictured }) {
                if (choice.name == "shBands") quality->diffuseIrradiance = DiffuseIrradiance::SphericalHarmonics;
                (void)setOption(*quality, choice.name, value);
            }
            settings.push_back(std::move(setting));
        }
        return settings;
    }

    /// A setting that does not change light changes the tone mapper, or nothing.
    Result<double> errorOf(Quality const& quality, Pictures const& exact) {
        Pictures drawn;
        const uint32_t frames = quality.antiAliasing == AntiAliasing::Taa ? kAccumulatedFrames : 1;
        if (const Result<void> result = draw(quality, frames, drawn); !result) return result.error();
        const double error = relativeError(drawn.linear, exact.linear);
        return error > 0 ? error : relativeError(drawn.display, exact.display);
    }

    Pictures const& exactOf(std::string_view choice) const { return choice == "antiAliasing" ? mSmooth : mExact; }

    Result<void> draw(Quality const& quality, uint32_t frames, Pictures& drawn) {
        View view = mView;
        view.quality = quality;
        for (const auto& [target, image] :
             { std::pair(&mLinear, &drawn.linear), std::pair(&mDisplay, &drawn.display) }) {
            Renderer renderer(mEngine); // without the frames of others
            for (uint32_t frame = 0; frame < frames; ++frame) renderer.render(mScene, view, *target);
            Result<Image> pixels = renderer.waitPixels(renderer.readPixels(*target));
            if (!pixels) return pixels.error();
            *image = std::move(*pixels);
        }
        return {};
    }

    Result<FrameCost> time(Setting& setting) {
        View view = mView;
        view.quality = setting.timed;
        const double before = processorMilliseconds();
        setting.renderer->render(mScene, view, mDisplay);
        mEngine.waitIdle();
        const std::vector<FrameTimings> timings = setting.renderer->takeTimings();
        if (timings.empty() || !(timings.back().gpuMilliseconds > 0)) {
            return fail(ErrorCode::Unsupported, "{} does not time its passes: costs cannot be measured on it",
                        mEngine.device().device);
        }
        const double device = timings.back().gpuMilliseconds;
        return FrameCost{ device, mIsCpu ? processorMilliseconds() - before : device };
    }

    void fillTimes(std::vector<Setting> const& settings, std::string_view standard, QualityEffect& effect) const {
        const auto base = std::ranges::find(settings, standard, &Setting::value);
        const double baseMilliseconds = median(base->device);
        for (size_t i = 0; i < settings.size(); ++i) {
            const std::vector<double> ratios = undisturbedRatios(settings[i].compared, base->compared);
            const size_t low = lowRank(ratios.size());
            effect.values[i].on(mEngine.device().backend) = { .milliseconds = baseMilliseconds * median(ratios),
                                                              .lowRatio = ratios[low],
                                                              .highRatio = ratios[ratios.size() - 1 - low] };
        }
    }

    Engine& mEngine;
    Scene const& mScene;
    View mView;
    Owned<SwapChain> mDisplay, mLinear;
    Pictures mExact, mSmooth;
    bool mIsCpu; // a CPU driver: its clock continues while other processes have the cores, processor time does not
};

Result<void> check(CostMeasurement const& measurement) {
    if (measurement.rounds < kFewestRounds || measurement.rounds > 1000) {
        return fail(ErrorCode::InvalidArgument, "{} rounds: give {} to 1000", measurement.rounds, kFewestRounds);
    }
    const std::vector<std::string_view> known = namesOf(optionsOf<Quality>());
    for (std::string const& name : measurement.choices) {
        if (std::ranges::find(known, name) == known.end())
            return fail(ErrorCode::NotFound, "there is no quality choice '{}'{}", name, suggestion(name, known));
    }
    return {};
}

} // namespace

Result<QualityCosts> measureQualityCosts(Engine& engine, Scene const& scene, View const& view,
                                         CostMeasurement const& measurement) {
    const engine::PublicCall call(engine, "measureQualityCosts(Engine, Scene, View, CostMeasurement)");
    if (const Result<void> checked = check(measurement); !checked) return checked.error();
    CostMeter meter(engine, scene, view);
    if (const Result<void> drawn = meter.drawExact(); !drawn) return drawn.error();
    QualityCosts costs{ .machine = engine.device().device, .driver = engine.device().driver, .size = view.size };
    for (Option const& choice : optionsOf<Quality>()) {
        auto const& asked = measurement.choices;
        if (!asked.empty() && std::ranges::find(asked, choice.name) == asked.end()) continue;
        Result<QualityEffect> effect = meter.measure(choice, measurement.rounds);
        if (!effect) return effect.error();
        costs.effects.push_back(std::move(*effect));
    }
    return costs;
}

} // namespace filament_core
