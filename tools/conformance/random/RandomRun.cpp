// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/random/RandomRun.h"

#include "filament_core/assets/files/FileBytes.h"
#include "toolkit/pictures/ImageCompare.h"
#include "toolkit/program/Console.h"
#include "toolkit/program/Interrupt.h"
#include "tools/conformance/Compare.h"
#include "tools/conformance/Runner.h"
#include "tools/conformance/random/MaterialGenerator.h"
#include "tools/conformance/random/MaterialReducer.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace filament_core::conformance {
namespace {

namespace fs = std::filesystem;

struct Drawn {
    std::string failure; ///< empty: the same bits
    bool differs = false;
    std::optional<Image> a, b;
};

/// No operation but bit casts, which materials define, tells one NaN from another.
void unifyNans(Image& image) {
    if (image.format != Format::RGBA16F) return;
    for (size_t i = 0; i + 1 < image.pixels.size(); i += 2) {
        uint16_t half = 0;
        std::memcpy(&half, &image.pixels[i], sizeof(half));
        if ((half & 0x7FFF) > 0x7C00) half = 0x7E00;
        std::memcpy(&image.pixels[i], &half, sizeof(half));
    }
}

/// Two failures with the same words are the same: numbers are lines, pixels and values.
std::string wordsOf(Drawn const& drawn) {
    if (drawn.differs) return "differs";
    std::string words;
    std::ranges::copy_if(drawn.failure, std::back_inserter(words), [](unsigned char c) { return !std::isdigit(c); });
    return words;
}

class RandomRun {
public:
    RandomRun(Options const& options, std::unique_ptr<Stage> a, std::unique_ptr<Stage> b)
            : mOptions(options), mFolder(options.out / "random"), mA(std::move(a)), mB(std::move(b)) {}

    Result<RandomResults> run() {
        RandomResults results;
        std::error_code ignored;
        fs::create_directories(mFolder, ignored);
        for (uint32_t i = 0; i < mOptions.random && !tools::isInterrupted(); ++i) {
            const uint64_t seed = mOptions.seed + i;
            tools::showProgress(fmt::format("{} of {} random materials, seed {}", i, mOptions.random, seed));
            const MaterialTree material = generateMaterial(seed);
            const Result<Drawn> drawn = draw(seed, print(material));
            if (!drawn) return drawn.error();
            ++results.drawn;
            if (drawn->failure.empty()) continue;
            Result<RandomFinding> finding = reduce(seed, material, *drawn);
            if (!finding) return finding.error();
            tools::clearProgress();
            std::printf("seed %llu: %s: %s\n", static_cast<unsigned long long>(seed), finding->what.c_str(),
                        finding->material.c_str());
            std::fflush(stdout);
            results.findings.push_back(std::move(*finding));
        }
        fs::remove(path("candidate", ".json"), ignored);
        return results;
    }

private:
    fs::path path(std::string const& name, const char* extension) const { return mFolder / (name + extension); }

    Result<void> write(fs::path const& file, std::string const& text) const {
        return assets::replaceFile(file, std::as_bytes(std::span(text)));
    }

    /// Writes NAME.mat and NAME.json and draws them.
    Result<Drawn> drawFiles(uint64_t seed, std::string const& text, std::string const& name) {
        if (auto done = write(path(name, ".mat"), text); !done) return done.error();
        if (auto done = write(path(name, ".json"), generateScene(seed, name + ".mat")); !done) return done.error();
        const Result<std::vector<SceneSpec>> specs = readSceneFile(path(name, ".json"));
        if (!specs) return specs.error();
        return drawSpec(specs->front());
    }

    /// Materials are cached by path, so every text has a name of its own.
    Result<Drawn> draw(uint64_t seed, std::string const& text) {
        const std::string name = fmt::format("candidate{}", mCandidates++);
        Result<Drawn> drawn = drawFiles(seed, text, name);
        std::error_code ignored;
        fs::remove(path(name, ".mat"), ignored);
        fs::remove(path(name, ".json"), ignored);
        return drawn;
    }

    Drawn drawSpec(SceneSpec const& spec) {
        Drawn drawn;
        for (Stage* stage : { mA.get(), mB.get() }) {
            Result<Shot> shot = shootOn(*stage, spec);
            if (!shot) return { .failure = shot.error().message, .differs = false, .a = {}, .b = {} };
            if (!shot->errors.empty()) return { .failure = shot->errors.front(), .differs = false, .a = {}, .b = {} };
            unifyNans(shot->image);
            (stage == mA.get() ? drawn.a : drawn.b) = std::move(shot->image);
        }
        const Comparator comparator = comparatorFor({}, mA->device(), mB->device());
        const Result<Comparison> compared = comparePictures(*drawn.a, *drawn.b, comparator);
        if (!compared) return { .failure = compared.error().message, .differs = false, .a = {}, .b = {} };
        drawn.differs = !compared->passed;
        if (drawn.differs) drawn.failure = fmt::format("{} pixels differ, {}", compared->differing, compared->first);
        return drawn;
    }

    static Result<Shot> shootOn(Stage& stage, SceneSpec const& spec) {
        if (const Result<void> set = stage.set(spec); !set) return set.error();
        return stage.shoot();
    }

    Result<RandomFinding> reduce(uint64_t seed, MaterialTree const& material, Drawn const& original) {
        const std::string name = fmt::format("{}", seed), words = wordsOf(original);
        if (auto done = write(path(name, ".mat"), print(material)); !done) return done.error();
        if (auto done = write(path(name, ".json"), generateScene(seed, name + ".mat")); !done) return done.error();
        if (!mOptions.reduce)
            return RandomFinding{ .seed = seed, .what = original.failure, .material = path(name, ".mat") };
        size_t tries = 0;
        const Reduction reduction = reduceMaterial(material, [&](std::string const& text) {
            tools::showProgress(fmt::format("seed {}: reducing, candidate {}", seed, ++tries));
            if (tools::isInterrupted()) return false;
            const Result<Drawn> drawn = draw(seed, text);
            return drawn.ok() && !drawn->failure.empty() && wordsOf(*drawn) == words;
        });
        Result<Drawn> last = drawFiles(seed, print(reduction.material), name + ".reduced");
        if (!last) return last.error();
        if (auto done = savePictures(name + ".reduced", *last); !done) return done.error();
        return RandomFinding{ .seed = seed,
                              .what = last->failure,
                              .material = path(name, ".reduced.mat"),
                              .trees = sizeOf(reduction.material),
                              .tries = reduction.tries };
    }

    Result<void> savePictures(std::string const& name, Drawn const& drawn) const {
        if (!drawn.differs) return {};
        const Image a = displayed(*drawn.a), b = displayed(*drawn.b);
        if (auto done = savePng(path(name, ".a.png"), a); !done) return done;
        if (auto done = savePng(path(name, ".b.png"), b); !done) return done;
        return savePng(path(name, ".difference.png"), tools::differenceImage(a, b));
    }

    Options const& mOptions;
    const fs::path mFolder;
    std::unique_ptr<Stage> mA, mB;
    size_t mCandidates = 0;
};

} // namespace

Result<RandomResults> runRandom(Options const& options) {
    Result<StagePair> stages = openPair(options, false);
    if (!stages) return stages.error();
    return RandomRun(options, std::move(stages->a), std::move(stages->b)).run();
}

} // namespace filament_core::conformance
