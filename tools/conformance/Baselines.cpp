// SPDX-License-Identifier: Apache-2.0
#include "tools/conformance/Baselines.h"

#include "base/Hash.h"
#include "toolkit/json/JsonFile.h"
#include "toolkit/machine/DriverPromise.h"
#include "toolkit/machine/Machine.h"
#include "toolkit/pictures/Flip.h"
#include "toolkit/pictures/Pixels.h"

#include <filament_core/Color.h>

#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace filament_core::conformance {
namespace {

std::string hexOf(Image const& thumbnail) {
    std::string text;
    for (size_t i = 0; i < thumbnail.pixels.size(); ++i) {
        if (i % 4 != 3) text += fmt::format("{:02x}", std::to_integer<int>(thumbnail.pixels[i]));
    }
    return text;
}

std::optional<Image> imageFromHex(std::string const& text) {
    Image image{ .width = kThumbnail, .height = kThumbnail };
    if (text.size() != size_t{ kThumbnail } * kThumbnail * 6) return std::nullopt;
    const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
    for (size_t i = 0; i < text.size(); i += 2) {
        image.pixels.push_back(static_cast<std::byte>(digit(text[i]) * 16 + digit(text[i + 1])));
        if (i % 6 == 4) image.pixels.push_back(std::byte{ 255 });
    }
    return image;
}

} // namespace

Machine thisMachine(std::string device, std::string driver) {
    return { .device = std::move(device), .driver = std::move(driver), .cpuFeatures = tools::cpuFeatures() };
}

std::string hashOf(Image const& image) { return fmt::format("{:016x}", hashBytes(image.pixels)); }

Image thumbnailOf(Image const& image) {
    Image small{ .width = kThumbnail, .height = kThumbnail };
    for (uint32_t y = 0; y < kThumbnail; ++y) {
        for (uint32_t x = 0; x < kThumbnail; ++x) {
            const uint32_t x0 = x * image.width / kThumbnail, x1 = std::max(x0 + 1, (x + 1) * image.width / kThumbnail);
            const uint32_t y0 = y * image.height / kThumbnail,
                           y1 = std::max(y0 + 1, (y + 1) * image.height / kThumbnail);
            float3 sum(0.0f);
            for (uint32_t v = y0; v < y1; ++v) {
                for (uint32_t u = x0; u < x1; ++u) {
                    const auto value = texel(image.format, image.pixels, size_t{ v } * image.width + u);
                    const float3 rgb = glm::clamp(float3(value[0], value[1], value[2]), float3(0.0f), float3(1.0f));
                    sum += image.format == Format::RGBA8 ? rgb : color::srgbFromLinear(rgb);
                }
            }
            const float3 mean = sum * (255 / static_cast<float>((x1 - x0) * (y1 - y0)));
            for (int c = 0; c < 3; ++c) small.pixels.push_back(static_cast<std::byte>(std::lround(mean[c])));
            small.pixels.push_back(std::byte{ 255 });
        }
    }
    return small;
}

Result<Baselines> Baselines::read(std::filesystem::path const& file) {
    Baselines baselines;
    if (!std::filesystem::exists(file)) return baselines;
    const Result<Json> json = readJson(file);
    if (!json) return fail(json.error().code, "{}; restore the file or use --update-baselines", json.error().message);
    try {
        Json const& machine = json->at("machine");
        baselines.mMachine = { machine.at("device"), machine.at("driver"), machine.at("cpuFeatures") };
        const Json versions = json->value("versions", Json::object());
        for (auto const& [version, others] : versions.items())
            baselines.mVersions[version] = others.get<std::map<std::string, std::string>>();
        for (auto const& [name, entry] : json->at("cases").items())
            baselines.mEntries[name] = { entry.at("hash"), entry.at("thumbnail") };
    } catch (Json::exception const& error) {
        return fail(ErrorCode::Corrupt, "{}: {}; restore the file or use --update-baselines", file.string(),
                    error.what());
    }
    return baselines;
}

Result<void> Baselines::write(std::filesystem::path const& file) const {
    Json json;
    json["machine"] = { { "device", mMachine.device },
                        { "driver", mMachine.driver },
                        { "cpuFeatures", mMachine.cpuFeatures } };
    for (auto const& [version, others] : mVersions) json["versions"][version] = others;
    json["cases"] = Json::object();
    for (auto const& [name, entry] : mEntries)
        json["cases"][name] = { { "hash", entry.hash }, { "thumbnail", entry.thumbnail } };
    return writeJson(file, json, 0);
}

BaselineVerdict Baselines::check(std::string const& name, Image const& image, Machine const& machine) const {
    const auto found = mEntries.find(name);
    if (found == mEntries.end()) return { false, "missing; look at the picture, then use --update-baselines" };
    if (const std::optional<std::string> hash = hashFor(name, found->second, machine)) {
        if (*hash == hashOf(image)) return { true, "equal" };
        return { false, fmt::format("hash {} instead of {}; if that is wanted, use {}", hashOf(image), *hash,
                                    machine == mMachine ? "--update-baselines" : "scripts/check_drivers --write") };
    }
    const std::optional<Image> stored = imageFromHex(found->second.thumbnail);
    if (!stored) return { false, "its thumbnail is damaged; use --update-baselines" };
    const double mean = flip(*stored, thumbnailOf(image)).mean;
    return { mean <= kThumbnailFlip,
             fmt::format("by thumbnail: FLIP {:.4f}, at most {} (made on {}, {}, {})", mean, kThumbnailFlip,
                         mMachine.device, mMachine.driver, mMachine.cpuFeatures) };
}

std::optional<std::string> Baselines::hashFor(std::string const& name, Entry const& entry,
                                              Machine const& machine) const {
    if (machine == mMachine) return entry.hash;
    const auto version = mVersions.find(tools::mesaVersion(machine.driver));
    if (version == mVersions.end() || machine.cpuFeatures != mMachine.cpuFeatures) return {};
    const auto other = version->second.find(name);
    return other == version->second.end() ? entry.hash : other->second;
}

void Baselines::store(std::string const& name, Image const& image, Machine const& machine) {
    if (!(machine == mMachine)) mEntries.clear(), mVersions.clear();
    mMachine = machine;
    mEntries[name] = { hashOf(image), hexOf(thumbnailOf(image)) };
}

} // namespace filament_core::conformance
