// SPDX-License-Identifier: Apache-2.0
/// JsonTree: reads fields of an untrusted JSON tree.
///   A JsonNode is a value and its path ("meshes[2].primitives[0].mode"), or missing. A field of a missing node is
///   another missing node, and its value is the fallback. A value of the wrong kind is an error with its path.
///   Thread  read-only after parse; the diagnostics belong to one thread.
///   Limits  integers up to 2^53 (exact in a JSON double). Values nested deeper than any field of glTF are null. Only
///           JsonTree.cpp includes the JSON library.
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

namespace filament_core::assets {

class JsonNode {
public:
    JsonNode(nlohmann::json const* value, std::string path, Diagnostics& diagnostics)
            : mValue(value), mPath(std::move(path)), mDiagnostics(&diagnostics) {}

    bool exists() const { return mValue != nullptr; }
    std::string const& path() const { return mPath; }
    Diagnostics& diagnostics() const { return *mDiagnostics; }
    /// The same value; what is wrong with it and below it goes to `diagnostics`.
    JsonNode reportingTo(Diagnostics& diagnostics) const { return { mValue, mPath, diagnostics }; }

    /// The member of an object; an error if this is not an object.
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
    /// A text that changes nothing, like a name: another kind of value is empty, with a warning.
    std::string label() const;

    /// An index below `count`, or kNone when absent. `what` names the array: "accessors".
    uint32_t index(size_t count, std::string_view what) const;
    uint32_t requiredIndex(size_t count, std::string_view what) const;

    /// Fills `values` if the array exists; an error for another length. Returns whether the array exists.
    bool numbers(std::span<double> values) const;
    std::vector<float> numberList() const;
    /// A list of texts in application-specific data ("extras"): empty if this is no object, or its member `key`
    /// is anything else.
    std::vector<std::string> textsOf(const char* key) const;
    std::vector<double> numbersOf(const char* key) const; ///< like textsOf(), for numbers

private:
    void refuse(std::string_view expected) const;

    nlohmann::json const* mValue;
    std::string mPath;
    Diagnostics* mDiagnostics;
};

/// A parsed tree; nodes point into it.
class JsonTree {
public:
    /// An error, naming the byte, for text that is not a JSON object.
    JsonTree(std::span<const std::byte> text, Diagnostics& diagnostics);
    JsonNode root(Diagnostics& diagnostics) const;

private:
    struct TakeApart {
        void operator()(nlohmann::json* value) const;
    };
    std::unique_ptr<nlohmann::json, TakeApart> mValue;
};

} // namespace filament_core::assets
