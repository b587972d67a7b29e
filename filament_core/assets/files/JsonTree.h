// SPDX-License-Identifier: Apache-2.0
/// GltfJson: reading fields of a JSON tree that nobody vouches for.
///   A JsonNode is a value and its path ("meshes[2].primitives[0].mode"), or nothing: asking a missing node for a field
///   gives another missing node, asking it for a value gives the fallback. A value of the wrong kind is refused with
///   its path.
///   Thread  read-only after parse; the diagnostics belong to one thread.
///   Limits  integers up to 2^53 (what a JSON double holds exactly). What is nested deeper than any field of glTF is
///           null. Only GltfJson.cpp sees the JSON library.
#pragma once

#include "filament_core/assets/files/Diagnostics.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament::assets {

class JsonNode {
public:
    JsonNode(nlohmann::json const* value, std::string path, Diagnostics& diagnostics)
            : mValue(value), mPath(std::move(path)), mDiagnostics(&diagnostics) {}

    bool exists() const { return mValue != nullptr; }
    std::string const& path() const { return mPath; }
    Diagnostics& diagnostics() const { return *mDiagnostics; }

    /// The member of an object; refuses anything else that is there.
    JsonNode operator[](const char* key) const;
    /// `extensions[name]`
    JsonNode extension(const char* name) const;

    /// The elements of an array.
    std::vector<JsonNode> elements() const;
    size_t elementCount() const;
    /// Visits the members of an object.
    void forEachMember(std::function<void(std::string const& key, JsonNode const& value)> const& visit) const;

    double number(double fallback) const;
    float numberInRange(float fallback, float low, float high) const; ///< clamps, with a warning
    uint64_t integer(uint64_t fallback) const;
    uint64_t requiredInteger() const;
    bool boolean(bool fallback) const;
    std::string text() const;

    /// An index below `count`, or kNone when absent. `what` names the array: "accessors".
    uint32_t index(size_t count, std::string_view what) const;
    uint32_t requiredIndex(size_t count, std::string_view what) const;

    /// Fills `values` if the array is there; refuses another length. Returns whether it was there.
    bool numbers(std::span<double> values) const;
    std::vector<float> numberList() const;

private:
    void refuse(std::string_view expected) const;

    nlohmann::json const* mValue;
    std::string mPath;
    Diagnostics* mDiagnostics;
};

/// A parsed tree; nodes point into it.
class JsonTree {
public:
    /// Refuses text that is not a JSON object, naming the byte.
    JsonTree(std::span<const std::byte> text, Diagnostics& diagnostics);
    JsonNode root(Diagnostics& diagnostics) const;

private:
    struct TakeApart {
        void operator()(nlohmann::json* value) const;
    };
    std::unique_ptr<nlohmann::json, TakeApart> mValue;
};

} // namespace filament::assets
