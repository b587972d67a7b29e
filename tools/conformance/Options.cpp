// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/Options.h"

#include "toolkit/mutations/Mutations.h"
#include "toolkit/paths/Paths.h"
#include "toolkit/program/CommandLine.h"
#include "tools/conformance/Machines.h"

#include <filament_core/Quality.h>

#include <algorithm>

namespace filament_core::conformance {
namespace {

using tools::invalidOption;

struct Words {
    std::string scenes = tools::sourceDir() / "tests/conformance/scenes";
    std::string baselines = tools::sourceDir() / "tests/conformance/baselines.json";
    std::string assets = tools::assetDir();
    std::string out = "conformance", shard = "0/1", shuffle, threads, mutations, shares = "off", pictures = "all";
    std::vector<std::string> backends, machines, merge, set;
    std::string journal, against, random = "0", seed = "1", reduce;
};

void declare(tools::CommandLine& app, Words& words, Options& options) {
    app.option("--scenes", words.scenes, "folder of scene files").typeName("DIR");
    app.option("--assets", words.assets, "where \"asset:\" paths of scenes begin").typeName("DIR");
    app.option("--baselines", words.baselines, "file of stored pictures, or none").typeName("FILE");
    app.flag("--update-baselines", options.updateBaselines, "store the pictures of this run as baselines");
    app.option("-o,--out", words.out, "folder of the report").typeName("DIR");
    app.option("--only", options.only, "cases whose names contain one of these").typeName("TEXT...");
    app.option("--cases", options.cases, "of those, the cases with these names").typeName("NAME...");
    app.option("--shuffle", words.shuffle, "draw the cases in another order, the same for a seed on every machine")
            .typeName("SEED");
    app.flag("--fresh", options.fresh, "open the devices anew for each case: each is a first frame");
    app.option("--shard", words.shard, "every N-th case beginning with case I; or auto, from the scheduler")
            .typeName("I/N");
    app.option("--merge", words.merge, "do not run: merge the results of shards").typeName("DIR...");
    app.option("--against", words.against,
               "compare with the report of another machine, driver or release: cases, pixels, passes")
            .typeName("DIR");
    app.option("--backends", words.backends, "vulkan gles, the first is the reference").typeName("NAME...");
    app.option("--require-device", options.requireDevice, "part of the device's name").typeName("NAME");
    app.option("--threads", words.threads, "also compare 0, 2 and 8 workers and affinity policies").typeName("on|off");
    app.option("--mutations", words.mutations, "check that injected defects are detected").typeName("on|off");
    app.option("--shares", words.shares, "also check that the shares of lights and effects add up to each picture")
            .typeName("on|off");
    app.option("--pictures", words.pictures, "all, or failed: leave out those of cases that passed")
            .typeName("all|failed");
    app.option("--machines", words.machines,
               "draw the cases again in child processes that simulate other machines: none, all, or those that --list "
               "prints")
            .typeName("NAME...");
    app.option("--journal", words.journal, "record the beginning and end of each case in this file").typeName("FILE");
    app.option("--set", words.set, "exact=off, or a quality choice of docs/quality.md, in every case; repeatable")
            .typeName("NAME=VALUE")
            .repeatable();
    app.option("--build", options.build, "name of this build in the results").typeName("NAME");
    app.option("--bisect", options.bisect, "do not run: find the first draw of a case that differs").typeName("CASE");
    app.option("--mutate", options.mutate, "with --bisect or --random: inject this defect into one backend")
            .typeName("MUTATION");
    app.option("--random", words.random, "do not run: draw this many generated materials, reduce what differs")
            .typeName("N");
    app.option("--reduce", words.reduce, "look for a small material that fails in the same way").typeName("on|off");
    app.option("--seed", words.seed, "of the first generated material; the next ones follow").typeName("S");
    app.flag("--list", options.list, "print the cases and the mutations");
}

Result<void> convertBackends(std::vector<std::string> const& words, Options& options) {
    if (words.empty()) return {};
    options.backends.clear();
    for (std::string const& word : words) {
        if (word == "vulkan")
            options.backends.push_back(Backend::Vulkan);
        else if (word == "gles")
            options.backends.push_back(Backend::Gles);
        else
            return invalidOption("--backends", word, "vulkan, gles or both");
    }
    return {};
}

Result<void> convertMachines(std::vector<std::string> const& words, Options& options) {
    for (std::string const& word : words) {
        if (word == "none") continue;
        if (word != "all" && !findMachine(word))
            return invalidOption("--machines", word, "none, all, or one of those that --list prints");
        for (std::string const& name : word == "all" ? quickMachines() : std::vector{ word }) {
            if (std::ranges::find(options.machines, name) == options.machines.end()) options.machines.push_back(name);
        }
    }
    std::error_code unknown;
    options.program = std::filesystem::read_symlink("/proc/self/exe", unknown);
    if (unknown && !options.machines.empty())
        return fail(ErrorCode::Unreadable,
                    "--machines starts this program again and cannot find it: /proc/self/exe: {}", unknown.message());
    return {};
}

Result<void> convertSet(std::vector<std::string> const& words, Options& options) {
    for (std::string const& word : words) {
        const size_t equals = word.find('=');
        if (equals == std::string::npos) return invalidOption("--set", word, "NAME=VALUE, see docs/quality.md");
        const std::string name = word.substr(0, equals), value = word.substr(equals + 1);
        if (name == "exact") {
            if (auto done = tools::convertSwitch("--set exact", value, options.exact); !done) return done;
            continue;
        }
        Quality probe;
        if (const Result<void> done = setOption(probe, name, value); !done)
            return fail(done.error().code, "--set {}: {}", word, done.error().message);
        options.quality.emplace_back(name, value);
    }
    return {};
}

Result<uint64_t> seedOf(const char* option, std::string const& word) {
    const auto seed = tools::wholeNumber(word, 0, 1'000'000'000);
    if (!seed) return invalidOption(option, word, "a whole number up to 1000000000");
    return uint64_t{ *seed };
}

Result<void> convertRandom(Words const& words, Options& options) {
    const auto count = tools::wholeNumber(words.random, 0, 1'000'000);
    if (!count) return invalidOption("--random", words.random, "a whole number up to 1000000");
    const Result<uint64_t> seed = seedOf("--seed", words.seed);
    if (!seed) return seed.error();
    options.random = *count, options.seed = *seed;
    return tools::convertSwitch("--reduce", words.reduce, options.reduce);
}

Result<void> convert(Words const& words, Options& options) {
    options.scenes = words.scenes, options.baselines = words.baselines, options.assets = words.assets;
    if (words.baselines == "none") options.baselines.clear();
    options.out = words.out;
    options.journal = words.journal;
    options.against = words.against;
    options.merge.assign(words.merge.begin(), words.merge.end());
    if (auto done = convertBackends(words.backends, options); !done) return done;
    if (auto done = convertSet(words.set, options); !done) return done;
    if (auto done = convertMachines(words.machines, options); !done) return done;
    if (auto done = tools::convertSwitch("--threads", words.threads, options.threads); !done) return done;
    if (auto done = tools::convertSwitch("--mutations", words.mutations, options.mutations); !done) return done;
    if (auto done = tools::convertSwitch("--shares", words.shares, options.shares); !done) return done;
    if (words.pictures != "all" && words.pictures != "failed")
        return invalidOption("--pictures", words.pictures, "all or failed");
    options.passedPictures = words.pictures == "all";
    if (!options.mutate.empty() && !findMutation(options.mutate))
        return invalidOption("--mutate", options.mutate, "one of those that --list prints");
    if (!options.bisect.empty() && options.backends.size() < 2 && options.mutate.empty())
        return fail(ErrorCode::InvalidArgument, "--bisect needs two backends, or one and --mutate");
    if (auto done = convertRandom(words, options); !done) return done;
    if (!words.shuffle.empty()) {
        const Result<uint64_t> seed = seedOf("--shuffle", words.shuffle);
        if (!seed) return seed.error();
        options.shuffle = *seed;
    }
    const Result<tools::Shard> shard = tools::parseShard(words.shard);
    if (!shard) return shard.error();
    options.shard = *shard;
    return {};
}

} // namespace

Result<std::optional<Options>> parseOptions(int argc, const char* const* argv) {
    tools::CommandLine app("Draws every scene on every backend with every number of workers and compares the pictures.",
                           "filament-conformance");
    Words words;
    Options options{ .build = FILAMENT_BUILD_NAME };
    declare(app, words, options);
    const Result<bool> parsed = app.parse(argc, argv);
    if (!parsed) return parsed.error();
    if (!*parsed) return std::optional<Options>();
    if (const Result<void> done = convert(words, options); !done) return done.error();
    return std::optional(options);
}

} // namespace filament_core::conformance
