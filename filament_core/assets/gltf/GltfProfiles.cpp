// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfProfiles.h"

#include <algorithm>
#include <limits>

namespace filament_core::assets {
namespace {

constexpr size_t kMaxProfiles = 1024, kMaxProfileBytes = size_t{ 64 } << 20;

std::string profileName(GltfProfile const& profile, uint32_t index) {
    const bool isFile = !profile.uri.empty() && !isDataUri(profile.uri);
    return isFile ? fmt::format("EXT_lights_ies.lights[{}] {}", index, profile.uri)
                  : fmt::format("EXT_lights_ies.lights[{}]", index);
}

/// Reads files until one is broken or they are too many.
class ProfileReader {
public:
    ProfileReader(GltfDocument const& document, GltfFolder const& folder, Diagnostics& diagnostics)
            : mDocument(document), mFolder(folder), mDiagnostics(diagnostics) {}

    void read(uint32_t index, GltfProfiles& profiles) {
        if (profiles.read.size() == kMaxProfiles)
            return refuse(index, ErrorCode::Unsupported, fmt::format("more than {} light profiles", kMaxProfiles));
        GltfProfile const& profile = mDocument.profiles[index];
        if (profile.view != kNone) return parse(index, mDocument.viewBytes[profile.view], profiles);
        const Result<std::vector<std::byte>> file = readGltfUri(profile.uri, mFolder);
        if (!file) return refuse(index, file.error().code, file.error().message);
        parse(index, *file, profiles);
    }

private:
    void refuse(uint32_t index, ErrorCode code, std::string const& why) {
        mDiagnostics.refuse(code, "EXT_lights_ies.lights[{}]: {}", index, why);
    }

    void parse(uint32_t index, std::span<const std::byte> bytes, GltfProfiles& profiles) {
        mBytes += bytes.size();
        if (mBytes > kMaxProfileBytes)
            return refuse(index, ErrorCode::Unsupported, "the light profiles take more than 64 MiB");
        GltfProfile const& profile = mDocument.profiles[index];
        Result<IesFile> file = readIes(bytes, profileName(profile, index));
        if (!file) return mDiagnostics.refuse(file.error());
        profiles.newIndex[index] = static_cast<uint32_t>(profiles.read.size());
        profiles.read.push_back({ profile.name, std::move(*file) });
    }

    GltfDocument const& mDocument;
    GltfFolder const& mFolder;
    Diagnostics& mDiagnostics;
    size_t mBytes = 0;
};

} // namespace

GltfProfiles readProfiles(GltfDocument const& document, GltfFolder const& folder, std::span<const LightData> lights,
                          Diagnostics& diagnostics) {
    GltfProfiles profiles;
    profiles.newIndex.resize(document.profiles.size(), kNone);
    ProfileReader reader(document, folder, diagnostics);
    for (LightData const& light : lights) {
        if (profiles.newIndex[light.profile] == kNone && diagnostics.ok()) reader.read(light.profile, profiles);
    }
    return profiles;
}

void addProfiledLights(std::vector<LightData> lights, GltfProfiles profiles, std::vector<LightData> const& others,
                       ModelData& model) {
    const auto first = static_cast<uint32_t>(others.size());
    model.lights = others;
    for (LightData& light : lights) {
        light.profile = profiles.newIndex[light.profile];
        const double candelas = double{ light.intensity } * double{ profiles.read[light.profile].file.peak };
        light.intensity = static_cast<float>(std::min(candelas, double{ std::numeric_limits<float>::max() }));
        model.lights.push_back(std::move(light));
    }
    for (NodeData& node : model.nodes) {
        if (node.profiledLight != kNone) node.profiledLight += first;
    }
    model.profiles = std::move(profiles.read);
}

} // namespace filament_core::assets
