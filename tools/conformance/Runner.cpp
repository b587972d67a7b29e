// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/Runner.h"

#include "base/Assert.h"
#include "base/Hash.h"
#include "toolkit/machine/DriverPromise.h"
#include "toolkit/machine/Machine.h"
#include "toolkit/mutations/Mutations.h"
#include "toolkit/pictures/ImageChecks.h"
#include "toolkit/pictures/ImageCompare.h"
#include "toolkit/program/Console.h"
#include "toolkit/program/Interrupt.h"
#include "toolkit/record/Bisect.h"
#include "tools/conformance/Compare.h"
#include "tools/conformance/Journal.h"
#include "tools/conformance/MachineRun.h"
#include "tools/conformance/MutantRun.h"
#include "tools/conformance/random/Dice.h"

#include <algorithm>
#include <chrono>

namespace filament_core::conformance {
namespace {

std::string fileName(std::string name) {
    std::replace_if(
            name.begin(), name.end(), [](char c) { return c == '/' || c == ' '; }, '.');
    return name;
}

/// Not the texture's name: passes that take turns with a texture name it after the first of them.
std::string placeOf(backend::CapturedAttachment const& attachment) {
    return attachment.isDepth ? "depth" : fmt::format("color {}", attachment.slot);
}

std::vector<AttachmentHash> hashesOf(backend::CapturedFrame const& frame) {
    std::vector<AttachmentHash> hashes;
    for (backend::CapturedPass const& pass : frame.passes) {
        for (backend::CapturedAttachment const& attachment : pass.attachments)
            hashes.push_back({ fmt::format("{:016x}", hashBytes(attachment.bytes)),
                               fmt::format("pass '{}', {}", pass.name, placeOf(attachment)) });
    }
    return hashes;
}

/// A configuration and its engine.
struct Actor {
    Configuration configuration;
    std::unique_ptr<Stage> stage;
};

/// Draws one case in all configurations and fills in its result.
class CaseRun {
public:
    CaseRun(Options const& options, std::vector<Actor>& actors, SceneSpec const& spec, ShareTally& shares)
            : mOptions(options), mActors(actors), mSpec(spec), mShares(shares) {
        mResult.name = spec.name;
    }

    CaseResult run(Baselines& baselines) {
        if (const std::string missing = missingFile(mSpec, mOptions.assets); !missing.empty()) {
            mResult.status = Status::Skipped;
            mResult.reasons.push_back(fmt::format("'{}' is not there; give its folder with --assets", missing));
            return mResult;
        }
        if (drawReference()) {
            checkBaseline(baselines);
            for (size_t i = 1; i < mActors.size(); ++i) compareWith(mActors[i]);
            if (mOptions.shares) addUpShares();
            if (mOptions.mutations) killMutants();
        }
        mResult.status = mResult.reasons.empty() ? Status::Passed : Status::Failed;
        return mResult;
    }

private:
    void blame(std::string who, std::string const& what) { mResult.reasons.push_back(std::move(who) + ": " + what); }

    std::optional<Shot> draw(Stage& stage, std::string const& who, bool inside) {
        const Result<void> set = stage.set(mSpec);
        if (!set) return blame(who, set.error().message), std::nullopt;
        std::optional<backend::CaptureRequest> request;
        if (inside) request.emplace();
        Result<Shot> shot = stage.shoot(request);
        if (!shot) return blame(who, shot.error().message), std::nullopt;
        for (std::string const& error : shot->errors) blame(who, error);
        return std::move(*shot);
    }

    bool drawReference() {
        Actor& actor = mActors[0];
        std::optional<Shot> shot = draw(*actor.stage, actor.configuration.name, true);
        if (!shot) return false;
        lookInside(*shot, actor.configuration.name);
        if (shot->inside) mResult.attachments = hashesOf(*shot->inside);
        mReference = std::move(*shot);
        mResult.hash = hashOf(mReference.image);
        mResult.image = save(displayed(mReference.image), "");
        return true;
    }

    void lookInside(Shot const& shot, std::string const& who) {
        if (const std::string fault = faultOf(shot.image); !fault.empty()) blame(who, fault);
        if (!shot.inside) return;
        if (const std::string where = notFinite(*shot.inside); !where.empty()) blame(who, where);
    }

    void checkBaseline(Baselines& baselines) {
        if (mOptions.baselines.empty()) return;
        DeviceDescription const& device = mActors[0].stage->device();
        const Machine machine = thisMachine(device.device, device.driver);
        if (mOptions.updateBaselines) baselines.store(mSpec.name, mReference.image, machine);
        const BaselineVerdict verdict = baselines.check(mSpec.name, mReference.image, machine);
        mResult.baseline = verdict.text;
        if (!verdict.passed) blame("baseline", verdict.text);
    }

    void compareWith(Actor& actor) {
        const bool inside = actor.configuration.stage.capture;
        const std::string& who = actor.configuration.name;
        std::optional<Shot> shot = draw(*actor.stage, who, inside);
        if (!shot) return;
        lookInside(*shot, who);
        const Comparator comparator =
                comparatorFor(mSpec.comparator, mActors[0].stage->device(), actor.stage->device());
        Result<Comparison> compared = comparePictures(mReference.image, shot->image, comparator);
        if (!compared) return blame(who, compared.error().message);
        compared->configuration = who;
        if (compared->differing > 0) saveDifference(*compared, shot->image);
        if (!compared->passed) blame(who, fmt::format("{} pixels differ, {}", compared->differing, compared->first));
        if (inside && comparator.kind == ComparatorKind::Bits) compareInside(actor, *shot, *compared);
        mResult.comparisons.push_back(std::move(*compared));
    }

    // Also detects what no picture shows: the next pass may round away a difference of an intermediate attachment.
    void compareInside(Actor& actor, Shot const& shot, Comparison& comparison) {
        if (!mReference.inside || !shot.inside) return blame(actor.configuration.name, "the frame was not captured");
        auto differs = compareFrames(*mReference.inside, *shot.inside);
        if (differs && !*differs) return;
        if (differs) differs = bisect(insideOf(*mActors[0].stage), insideOf(*actor.stage));
        const std::string where = !differs   ? differs.error().message
                                  : *differs ? (*differs)->line()
                                             : std::string("differs from frame to frame");
        comparison.first = where;
        comparison.passed = false;
        blame(actor.configuration.name, where);
    }

    /// With one number of workers for each API.
    void addUpShares() {
        std::optional<uint64_t> hash;
        for (Actor& actor : mActors) {
            if (!actor.configuration.stage.capture) continue;
            const std::string& who = actor.configuration.name;
            Result<ShareVerdict> verdict = actor.stage->shares();
            if (!verdict) return blame(who, verdict.error().message);
            for (std::string const& fault : verdict->faults) blame(who, fault);
            if (hash && *hash != verdict->hash && mSpec.comparator.kind == ComparatorKind::Bits)
                blame(who, "shares differ from those of " + mActors[0].configuration.name);
            hash = verdict->hash;
            mShares += verdict->tally;
        }
    }

    void killMutants() {
        if (mSpec.kills.empty()) return;
        tryMutant(std::string(kNoDefect));
        // A picture of the lists themselves may show it.
        const auto isListed = [](auto const& light) { return !std::holds_alternative<SunLight>(light); };
        if (std::ranges::any_of(mSpec.lights, isListed) && mSpec.view.debugView != DebugView::Froxels)
            tryMutant(std::string(kOneList));
        for (std::string const& name : mSpec.kills) tryMutant(name);
    }

    void tryMutant(std::string const& name) {
        Mutation const* mutation = findMutation(name);
        if (!mutation) return blame("kills", fmt::format("there is no mutation '{}'", name));
        tools::showProgress(fmt::format("{}: mutant '{}'", mSpec.name, name));
        const auto actor = std::ranges::find_if(
                mActors, [&](Actor const& each) { return mutation->fits(each.configuration.stage.backend); });
        if (actor == mActors.end()) return; // a run without that API
        Result<MutantVerdict> verdict = runMutant(*mutation, actor->configuration.stage, mSpec, mReference.image);
        if (!verdict) return blame("mutant " + name, verdict.error().message);
        for (std::string const& error : verdict->errors) blame("mutant " + name, error);
        if (!verdict->fault.empty()) blame("mutations", verdict->fault);
        if (verdict->kill) mResult.kills.push_back(std::move(*verdict->kill));
    }

    void saveDifference(Comparison& comparison, Image const& image) {
        const std::string suffix = "." + comparison.configuration;
        const Image a = displayed(mReference.image), b = displayed(image);
        comparison.image = save(b, suffix);
        comparison.difference = save(tools::differenceImage(a, b), suffix + ".difference");
    }

    std::string save(Image const& image, std::string const& suffix) {
        const std::string file = "images/" + fileName(mSpec.name + suffix) + ".png";
        if (const Result<void> saved = savePng(mOptions.out / file, image); !saved)
            blame("report", saved.error().message);
        return file;
    }

    Options const& mOptions;
    std::vector<Actor>& mActors;
    SceneSpec const& mSpec;
    ShareTally& mShares;
    Shot mReference;
    CaseResult mResult;
};

Result<std::vector<Actor>> openActors(std::vector<Configuration> const& configurations) {
    std::vector<Actor> actors;
    for (Configuration const& configuration : configurations) {
        tools::showProgress("opening " + configuration.name);
        Result<std::unique_ptr<Stage>> stage = Stage::open(configuration.stage);
        if (!stage) return fail(stage.error().code, "{}: {}", configuration.name, stage.error().message);
        actors.push_back({ configuration, std::move(*stage) });
    }
    return actors;
}

void warnOfDrivers(std::vector<Actor> const& actors) {
    std::vector<DeviceDescription> devices;
    for (Actor const& actor : actors) devices.push_back(actor.stage->device());
    if (const std::string note = tools::driverNote(devices, tools::cpuFeatures()); !note.empty())
        tools::printWarning(note);
}

void showCase(size_t index, size_t count, std::string const& name) {
    constexpr size_t kBarWidth = 30;
    const size_t done = index * kBarWidth / count;
    tools::showProgress(fmt::format("[{}{}] {}/{} {}", std::string(done, '#'), std::string(kBarWidth - done, ' '),
                                    index, count, name));
}

Result<SceneSpec> findCase(std::vector<SceneSpec> const& cases, std::string const& name) {
    for (SceneSpec const& spec : cases) {
        if (spec.name == name) return spec;
    }
    return fail(ErrorCode::NotFound, "there is no case '{}'; --list prints all", name);
}

/// Nothing, or the error that the defect of --mutate cannot be found.
Result<std::string> proofOfEquality(Options const& options, StagePair const& stages) {
    Mutation const* mutation = findMutation(options.mutate);
    if (!mutation || mutation->name == kNoDefect) return std::string();
    const DefectReach a = stages.a->reach(), b = stages.b->reach();
    const std::string why = whyUndrawn(*mutation, a.changed.empty() ? b : a);
    if (why.empty()) return std::string();
    return fail(ErrorCode::InvalidArgument, "{}: {}", options.bisect, why);
}

/// Draws the cases in this process. Its engines are gone when it returns.
Result<Results> runHere(Options const& options, std::vector<SceneSpec> const& cases) {
    Result<Baselines> baselines = Baselines::read(options.baselines);
    if (!baselines) return baselines.error();
    Result<std::vector<Actor>> actors = openActors(configurationsOf(options));
    if (!actors) return actors.error();
    Results results{ .build = options.build, .reference = actors->front().configuration.name };
    warnOfDrivers(*actors);
    for (Actor const& actor : *actors)
        results.devices[toString(actor.stage->device().backend)] =
                actor.stage->device().device + ", " + actor.stage->device().driver;
    Journal journal(options.journal);
    ShareTally shares;
    journal.devices(results.devices);
    for (size_t i = 0; i < cases.size() && !tools::isInterrupted(); ++i) {
        if (options.fresh && i > 0) {
            actors->clear(); // before others are opened: nothing of them is left
            actors = openActors(configurationsOf(options));
            if (!actors) return actors.error();
        }
        showCase(i, cases.size(), cases[i].name);
        journal.begins(cases[i].name);
        const auto start = std::chrono::steady_clock::now();
        results.cases.push_back(CaseRun(options, *actors, cases[i], shares).run(*baselines));
        results.seconds[cases[i].name] =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        journal.ends(results.cases.back());
        tools::clearProgress();
        for (std::string const& reason : results.cases.back().reasons)
            std::printf("%-8s %s: %s\n", toString(results.cases.back().status), cases[i].name.c_str(), reason.c_str());
    }
    if (options.shares) std::printf("%s\n", shares.line().c_str());
    std::ranges::sort(results.cases, {}, &CaseResult::name); // however they were shuffled
    if (options.updateBaselines && !tools::isInterrupted()) {
        if (const Result<void> written = baselines->write(options.baselines); !written) return written.error();
    }
    return results;
}

} // namespace

std::vector<Configuration> configurationsOf(Options const& options) {
    const std::filesystem::path work = options.out / "work";
    const auto stage = [&](Backend backend, int workers, ThreadAffinity affinity, bool capture) {
        return StageOptions{ .backend = backend,
                             .requireDevice = options.requireDevice,
                             .workers = workers,
                             .affinity = affinity,
                             .exact = options.exact,
                             .capture = capture,
                             .work = work,
                             .assets = options.assets };
    };
    std::vector<Configuration> all;
    for (const Backend backend : options.backends)
        all.push_back({ toString(backend), stage(backend, 1, ThreadAffinity::None, true) });
    if (!options.threads) return all;
    for (const Backend backend : options.backends) {
        for (const int workers : { 0, 2, 8 })
            all.push_back({ fmt::format("{} workers {}", toString(backend), workers),
                            stage(backend, workers, ThreadAffinity::None, false) });
    }
    const Backend first = options.backends.front();
    all.push_back({ fmt::format("{} pinned", toString(first)), stage(first, 2, ThreadAffinity::Pin, false) });
    all.push_back({ fmt::format("{} big cores", toString(first)), stage(first, 2, ThreadAffinity::BigCores, false) });
    return all;
}

Result<StagePair> openPair(Options const& options, bool capture) {
    Options two = options;
    two.threads = false;
    std::vector<Configuration> configurations = configurationsOf(two);
    if (configurations.size() == 1) configurations.push_back(configurations.front());
    Mutation const* mutation = findMutation(options.mutate);
    StagePair pair;
    for (std::unique_ptr<Stage>* made : { &pair.a, &pair.b }) {
        StageOptions& stage = configurations[made == &pair.b].stage;
        stage.capture = capture;
        const bool isMutant = mutation && mutation->fits(stage.backend);
        auto opened = Stage::open(stage, isMutant ? mutation->make() : nullptr);
        if (!opened) return opened.error();
        if (isMutant) mutation = nullptr; // only one of the two
        *made = std::move(*opened);
    }
    if (mutation)
        return fail(ErrorCode::InvalidArgument, "--mutate {} edits the shaders of {}, which --backends lacks",
                    mutation->name, toString(*mutation->api));
    return pair;
}

void overrideQuality(std::vector<SceneSpec>& cases, Options const& options) {
    for (SceneSpec& spec : cases) {
        for (auto const& [name, value] : options.quality) {
            const Result<void> done = setOption(spec.view.quality, name, value);
            FILAMENT_ASSERT(done.ok(), "parseOptions() checks every --set");
        }
    }
}

std::vector<SceneSpec> casesOf(std::vector<SceneSpec> all, Options const& options) {
    const auto contains = [](std::string const& name, std::string const& part) {
        return name.find(part) != std::string::npos;
    };
    const auto isOneOf = [](std::vector<std::string> const& words, auto const& matches) {
        return words.empty() || std::ranges::any_of(words, matches);
    };
    const auto wanted = [&](SceneSpec const& spec) {
        return isOneOf(options.only, [&](auto const& part) { return contains(spec.name, part); }) &&
               isOneOf(options.cases, [&](auto const& name) { return spec.name == name; });
    };
    std::erase_if(all, [&](SceneSpec const& spec) { return !wanted(spec); });
    if (options.shuffle) Dice(*options.shuffle).shuffle(all);
    std::vector<SceneSpec> chosen;
    for (size_t i = options.shard.index; i < all.size(); i += options.shard.count) chosen.push_back(std::move(all[i]));
    return chosen;
}

Result<Results> runCases(Options const& options, std::vector<SceneSpec> const& cases) {
    Result<Results> results = runHere(options, cases);
    if (!results || tools::isInterrupted()) return results;
    if (const Result<void> done = drawOnMachines(options, *results); !done) return done.error();
    return results;
}

Result<std::string> bisectCase(Options const& options, std::vector<SceneSpec> const& cases) {
    const Result<SceneSpec> spec = findCase(cases, options.bisect);
    if (!spec) return spec.error();
    const Result<StagePair> stages = openPair(options, true);
    if (!stages) return stages.error();
    for (Stage* stage : { stages->a.get(), stages->b.get() }) {
        if (const Result<void> set = stage->set(*spec); !set) return set.error();
    }
    auto found = bisect(insideOf(*stages->a), insideOf(*stages->b));
    if (!found) return found.error();
    if (*found) return (*found)->line();
    return proofOfEquality(options, *stages);
}

} // namespace filament_core::conformance
