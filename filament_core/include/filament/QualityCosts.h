// SPDX-License-Identifier: Apache-2.0
/// QualityCosts: what every value of every quality choice costs and how far it is from the truth, as measured on one
/// machine. What a QualityBudget buys from.
///   Choices  fields of Quality (qualityChoices()), all of which may change from frame to frame. What is chosen when a
///            model or an environment is loaded is not a matter of a frame's budget and not in the table.
///   Time     device time of a whole frame with this value, everything else at its default. Only the ratio to the
///            default value of the same choice is used: both were measured in turns, so that the load of the machine
///            cancels. On CPU drivers (llvmpipe) the ratio is that of processor time, which leaves out what other
///            processes do.
///   Error    root mean square of (picture - exact) / (exact + 1 % of its mean), luminance, scene-linear: everything
///            else at its most exact. 0 for the value that the others are compared with. What changes nothing there is
///            compared as displayed, behind the tone mapper.
///   File     JSON, see docs/quality.md: { "machine", "driver", "commit", "size", "effects": [ ... ] }.
///   Fails    readQualityCosts(): Corrupt or InvalidArgument with file, element, and what would be right. Whoever makes
///            a table without it sees to it that names are known and every choice has its default.
///   Thread   values; any thread.  Memory: some kilobytes.
#pragma once

#include <filament/Backend.h>
#include <filament/Math.h>
#include <filament/Result.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace filament {

class Engine;
class Scene;
struct View;

struct QualityCost {
    struct Time {
        double milliseconds = 0;
        double lowRatio = 1, highRatio = 1; ///< 99 % confidence of the ratio to the default value's time
    };
    std::string value; ///< a word that setQuality() takes
    double error = 0;  ///< relative, [0, 100]
    Time vulkan{}, gles{};

    Time const& on(Backend backend) const { return backend == Backend::Gles ? gles : vulkan; }
    Time& on(Backend backend) { return backend == Backend::Gles ? gles : vulkan; }
};

struct QualityEffect {
    std::string name; ///< of the choice
    std::vector<QualityCost> values;
};

struct QualityCosts {
    std::string machine, driver, commit; ///< where it was measured
    uint2 size{ 0 };                     ///< pixels of the measured frame
    std::vector<QualityEffect> effects;

    /// A frame with nothing but defaults: the median over all effects.
    double frameMilliseconds(Backend backend) const;
};

/// `name` begins every message.
Result<QualityCosts> readQualityCosts(std::string_view json, std::string_view name);
Result<QualityCosts> loadQualityCosts(std::filesystem::path const& file);
std::string toJson(QualityCosts const& costs);
/// The table that the library brings along: the showcase on the CPU drivers of Mesa.
QualityCosts const& defaultQualityCosts();

struct CostMeasurement {
    uint32_t rounds = 15;               ///< [15, 1000]: every value of a choice once a round, in turns
    std::vector<std::string> choices{}; ///< names; empty: all that there are
};

/// Measures one scene on the engine's backend, the view's quality being what the other choices have. Draws some 30
/// pictures with programs of their own, then rounds * 30 frames: seconds to minutes. The other backend's times stay 0;
/// see addBackend(). Fails: InvalidArgument for an unknown choice; what the device says.
Result<QualityCosts> measureQualityCosts(Engine& engine, Scene const& scene, View const& view,
                                         CostMeasurement const& measurement = {});
/// Takes over the times of `backend` from a measurement of the same choices.
void addBackend(QualityCosts& costs, QualityCosts const& other, Backend backend);

} // namespace filament
