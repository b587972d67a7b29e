// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/Options.h"

#include "toolkit/program/CommandLine.h"
#include "tools/reference/Division.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace filament_core::reference {
namespace {

using tools::invalidOption;
using tools::wholeNumber;

struct Words {
    std::string integrator = "path", samples = "256", error, maxBounces = "64", seed = "1", filter = "box",
                occlusion = "auto", visibility = "correlated", fresnel = "schlick", diffuse = "lambert",
                energy = "compensated", coupling = "engine", lobes = "both", rotation = "0", threads,
                specularLight = "integral", diffuseLight = "integral", solidTint = "each-interface",
                occlusionRadius = "0", occlusionRays = "64", probe = "0", tile, samplesOfPart, shard;
    std::vector<std::string> merge;
};

template <class T, size_t N>
using Names = std::array<std::pair<std::string_view, T>, N>;

template <class T, size_t N>
Result<void> choose(const char* option, std::string const& word, Names<T, N> const& names, T& result) {
    std::string list;
    for (size_t i = 0; i < N; ++i) {
        if (names[i].first == word) {
            result = names[i].second;
            return {};
        }
        list += i == 0 ? "" : i + 1 == N ? " or " : ", ";
        list += names[i].first;
    }
    return invalidOption(option, word, list.c_str());
}

Result<void> convertChoices(Words const& words, Options& options) {
    ReferenceSettings& settings = options.settings;
    if (auto done = choose(
                "--integrator", words.integrator,
                Names<Integrator, 2>{ { { "path", Integrator::Path }, { "unoccluded", Integrator::Unoccluded } } },
                settings.integrator);
        !done) {
        return done;
    }
    if (auto done = choose("--filter", words.filter,
                           Names<PixelFilter, 2>{ { { "box", PixelFilter::Box }, { "center", PixelFilter::Center } } },
                           settings.filter);
        !done) {
        return done;
    }
    return choose("--occlusion-map", words.occlusion,
                  Names<Switch, 3>{ { { "auto", Switch::Auto }, { "on", Switch::On }, { "off", Switch::Off } } },
                  settings.occlusionMap);
}

Result<void> convertMicrofacets(Words const& words, Options& options) {
    BsdfModel& bsdf = options.settings.bsdf;
    if (auto done = choose("--visibility", words.visibility,
                           Names<SpecularVisibility, 3>{ { { "correlated", SpecularVisibility::Correlated },
                                                           { "fast", SpecularVisibility::Fast },
                                                           { "uncorrelated", SpecularVisibility::Uncorrelated } } },
                           bsdf.visibility);
        !done) {
        return done;
    }
    if (auto done = choose(
                "--fresnel", words.fresnel,
                Names<FresnelTerm, 2>{ { { "schlick", FresnelTerm::Schlick }, { "exact", FresnelTerm::Exact } } },
                bsdf.fresnel);
        !done) {
        return done;
    }
    return choose("--energy", words.energy,
                  Names<EnergyTerm, 2>{ { { "compensated", EnergyTerm::Compensated },
                                          { "single-scatter", EnergyTerm::SingleScatter } } },
                  bsdf.energy);
}

Result<void> convertLobes(Words const& words, Options& options) {
    BsdfModel& bsdf = options.settings.bsdf;
    if (auto done = choose(
                "--diffuse", words.diffuse,
                Names<DiffuseTerm, 2>{ { { "lambert", DiffuseTerm::Lambert }, { "disney", DiffuseTerm::Disney } } },
                bsdf.diffuse);
        !done) {
        return done;
    }
    if (auto done = choose("--coupling", words.coupling,
                           Names<CouplingTerm, 4>{ { { "engine", CouplingTerm::Engine },
                                                     { "ambient-only", CouplingTerm::AmbientOnly },
                                                     { "always", CouplingTerm::Always },
                                                     { "never", CouplingTerm::Never } } },
                           bsdf.coupling);
        !done) {
        return done;
    }
    if (auto done = choose(
                "--solid-tint", words.solidTint,
                Names<SolidTint, 2>{ { { "each-interface", SolidTint::EachInterface }, { "once", SolidTint::Once } } },
                bsdf.solidTint);
        !done) {
        return done;
    }
    return choose("--lobes", words.lobes,
                  Names<LobeChoice, 3>{ { { "both", LobeChoice::Both },
                                          { "diffuse", LobeChoice::Diffuse },
                                          { "specular", LobeChoice::Specular } } },
                  bsdf.lobes);
}

Result<void> convertPrefiltered(Words const& words, Options& options) {
    BsdfModel& bsdf = options.settings.bsdf;
    if (auto done = choose("--specular-light", words.specularLight,
                           Names<SpecularLight, 2>{ { { "integral", SpecularLight::Integral },
                                                      { "split-sum", SpecularLight::SplitSum } } },
                           bsdf.specularLight);
        !done) {
        return done;
    }
    return choose("--diffuse-light", words.diffuseLight,
                  Names<DiffuseLight, 2>{
                          { { "integral", DiffuseLight::Integral }, { "harmonics", DiffuseLight::Harmonics } } },
                  bsdf.diffuseLight);
}

Result<void> convertNumbers(Words const& words, Options& options) {
    const auto samples = wholeNumber(words.samples, 1, 1u << 20);
    if (!samples) return invalidOption("--spp", words.samples, "a whole number from 1 to 1048576");
    options.settings.samplesPerPixel = *samples;

    const auto bounces = wholeNumber(words.maxBounces, 1, 4096);
    if (!bounces) return invalidOption("--max-bounces", words.maxBounces, "a whole number from 1 to 4096");
    options.settings.maxBounces = *bounces;

    const auto radius = tools::finiteNumber(words.occlusionRadius);
    if (!radius || *radius < 0) return invalidOption("--ao-radius", words.occlusionRadius, "metres, 0 for none");
    options.settings.occlusionRadius = *radius;

    const auto rays = wholeNumber(words.occlusionRays, 1, 65536);
    if (!rays) return invalidOption("--ao-rays", words.occlusionRays, "a whole number from 1 to 65536");
    options.settings.occlusionRays = *rays;

    const auto probe = wholeNumber(words.probe, 0, 4096);
    if (!probe || (*probe > 0 && *probe < 16))
        return invalidOption("--probe", words.probe, "a whole number from 16 to 4096, or 0");
    options.probeSize = *probe;

    const auto seed = wholeNumber(words.seed, 0, ~0u);
    if (!seed) return invalidOption("--seed", words.seed, "a whole number from 0 to 4294967295");
    options.settings.seed = *seed;

    const auto rotation = tools::finiteNumber(words.rotation);
    if (!rotation || *rotation < -360 || *rotation > 360) {
        return invalidOption("--ibl-rotation", words.rotation, "degrees from -360 to 360");
    }
    options.rotationDegrees = *rotation;

    if (!words.error.empty()) {
        const auto error = tools::finiteNumber(words.error);
        if (!error || *error < 1e-6 || *error > 1)
            return invalidOption("--error", words.error, "a number from 1e-6 to 1");
        options.settings.relativeError = static_cast<float>(*error);
    }
    if (words.threads.empty()) return {};
    const auto threads = wholeNumber(words.threads, 1, 256);
    if (!threads) return invalidOption("--threads", words.threads, "a whole number from 1 to 256");
    options.workers = static_cast<int>(*threads) - 1; // this thread works, too
    return {};
}

void declare(tools::CommandLine& app, Words& words, Options& options) {
    app.option("--integrator", words.integrator, "path: all light; unoccluded: one reflection, no shadows (path)");
    app.option("--spp", words.samples, "samples per pixel; with --error the maximum (256)");
    app.option("--error", words.error, "stop when the relative standard error of the picture is below this");
    app.option("--max-bounces", words.maxBounces, "maximum number of reflections per path (64)");
    app.option("--seed", words.seed, "seed of the noise (1)");
    app.option("--filter", words.filter, "box: the mean over a pixel; center: its middle (box)");
    app.option("--occlusion-map", words.occlusion, "on, off or auto: with unoccluded only (auto)");
    app.option("--ao-radius", words.occlusionRadius,
               "with unoccluded: metres within which surfaces dim indirect light, as ambient occlusion does (0)");
    app.option("--ao-rays", words.occlusionRays, "rays for that, each sample of a pixel (64)");
    app.flag("--ao-bent", options.settings.occlusionBends, "diffuse light comes from the mean open direction");
    app.option("--visibility", words.visibility, "correlated, fast or uncorrelated (correlated)");
    app.option("--fresnel", words.fresnel, "schlick or exact (schlick)");
    app.option("--diffuse", words.diffuse, "lambert or disney (lambert)");
    app.option("--energy", words.energy, "compensated or single-scatter (compensated)");
    app.option("--coupling", words.coupling,
               "engine, ambient-only, always or never: the light for which the diffuse lobe gets only what the "
               "specular lobe leaves");
    app.option("--lobes", words.lobes, "both, diffuse or specular (both)");
    app.option("--solid-tint", words.solidTint,
               "each-interface or once: how often the base colour of a solid applies (each-interface)");
    app.option("--specular-light", words.specularLight,
               "integral or split-sum: how the environment is gathered (integral)");
    app.option("--diffuse-light", words.diffuseLight, "integral or harmonics: the same for diffuse light (integral)");
    app.option("--ibl-rotation", words.rotation, "rotation of the environment around +Y in degrees (0)");
    app.option("--threads", words.threads, "number of tracing threads (one per core)");
    app.option("--tile", words.tile, "render a part: X,Y,W,H in pixels, or I/CxR: tile I of C columns and R rows");
    app.option("--samples", words.samplesOfPart,
               "render a part: COUNT samples of every pixel from FIRST on, whole passes")
            .typeName("FIRST,COUNT");
    app.option("--shard", words.shard, "render part I of N; or auto, from the scheduler").typeName("I/N");
    app.option("--merge", words.merge, "do not render: write the picture of parts, files or folders of them")
            .typeName("FILE...");
    app.option(
            "--probe", words.probe,
            "write DIR/probe.ktx2 instead: what a reflection probe sees from the camera's place; texels of a side (0)");
    app.flag("--error-image", options.writesErrors, "write DIR/error.exr: the standard error of every pixel");
}

Result<void> convertPart(Words const& words, Options& options) {
    options.merge.assign(words.merge.begin(), words.merge.end());
    const bool isPart = !words.tile.empty() || !words.samplesOfPart.empty();
    if (!isPart && words.shard.empty()) return {};
    if (!words.merge.empty())
        return fail(ErrorCode::InvalidArgument,
                    "--merge renders nothing; give --shard, --tile and --samples without it");
    if (options.settings.relativeError > 0)
        return fail(ErrorCode::InvalidArgument,
                    "--error needs the whole picture; give parts a number of samples, --spp");
    const PassPlan plan = planOf(options.settings);
    if (words.shard.empty()) {
        const Result<FilmRegion> region = regionOf(words.tile, words.samplesOfPart, options.view.size, plan);
        if (!region) return region.error();
        options.part = *region;
        return {};
    }
    if (isPart)
        return fail(ErrorCode::InvalidArgument, "--shard chooses the part; give it without --tile and --samples");
    const Result<tools::Shard> shard = tools::parseShard(words.shard);
    if (!shard) return shard.error();
    const Result<FilmRegion> region = regionOf(*shard, options.view.size, plan);
    if (!region) return region.error();
    options.shard = *shard, options.part = *region;
    return {};
}

} // namespace

Result<std::optional<Options>> parseOptions(int argc, const char* const* argv) {
    Options options;
    tools::SceneWords sceneWords;
    Words words;
    tools::CommandLine app{
        "Renders what the engine approximates: paths traced in double precision, with a standard error.",
        "filament-reference"
    };
    tools::declareSceneOptions(app, sceneWords, options);
    declare(app, words, options);
    const Result<bool> parsed = app.parse(argc, argv);
    if (!parsed) return parsed.error();
    if (!*parsed) return std::optional<Options>{};
    if (const Result<void> done = tools::convertSceneOptions(sceneWords, options); !done) return done.error();
    for (auto convert :
         { convertChoices, convertMicrofacets, convertLobes, convertPrefiltered, convertNumbers, convertPart }) {
        if (const Result<void> done = convert(words, options); !done) return done.error();
    }
    // which part of the image is rendered, how and where to is not of the image
    options.arguments =
            app.givenBesides({ "--help", "--out", "--threads", "--tile", "--samples", "--shard", "--merge" });
    if (!options.merge.empty() && !options.arguments.empty())
        return fail(ErrorCode::InvalidArgument, "--merge takes all settings from the parts; leave out '{}'",
                    tools::joined(options.arguments));
    return std::optional(std::move(options));
}

} // namespace filament_core::reference
