// SPDX-License-Identifier: Apache-2.0
/// Loaded: what the files of a document became on one engine, and the loads that bring it there.
///   Thread  the app thread of the engine.
///   Fails   take(): the loader's error, one line.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/image/Image.h"
#include "filament_core/scene/Materials.h"
#include "toolkit/materials/MaterialStand.h"
#include "tools/view/document/Document.h"
#include "tools/view/stage/Background.h"

#include <filament_core/Engine.h>
#include <filament_core/LoadTicket.h>
#include <filament_core/Look.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace filament_core::view {

/// The value of a parameter of an instance, as it is now.
Result<ParameterValue> parameterOf(Engine& engine, MaterialInstance instance, std::string_view parameter);

/// The textures of an instance, and the same ones put back: those of the material's file after edits.
std::vector<scene::TextureBinding> texturesOf(Engine& engine, MaterialInstance instance);
void setTextures(Engine& engine, MaterialInstance instance, std::vector<scene::TextureBinding> const& textures);

/// A material on its stand, and the values that its file gives.
struct LoadedMaterial {
    std::shared_ptr<const tools::MaterialFile> file;
    tools::MaterialStand stand;
    std::vector<std::pair<std::string, ParameterValue>> values; ///< without textures and arrays
    std::vector<scene::TextureBinding> textures;
};

/// A model or a material.
struct LoadedModel {
    std::filesystem::path file;
    std::variant<Model, LoadedMaterial> content;

    Model const* model() const { return std::get_if<Model>(&content); }
    LoadedMaterial* material() { return std::get_if<LoadedMaterial>(&content); }
    LoadedMaterial const* material() const { return std::get_if<LoadedMaterial>(&content); }
    Box bounds() const;
};

struct LoadState {
    std::string step; ///< "decoding"
    size_t done = 0, total = 0;
    bool isFinished = false;
};

/// A material file, and what of it needs no engine.
struct ReadMaterial {
    tools::MaterialFile file;
    scene::Material shown;
    std::optional<scene::Material> slab;
};

class ModelLoad {
public:
    using Value = LoadedModel;
    ModelLoad(Engine& engine, DocumentModel const& model);
    LoadState poll(size_t sliceBytes);
    LoadState state() const;
    Result<LoadedModel> take(Engine& engine);
    void abandon(Abandoned& abandoned);

private:
    using Compile = Background<Result<ReadMaterial>>;
    std::filesystem::path mFile;
    std::variant<LoadTicket<Model>, Compile> mWork;
};

class EnvironmentLoad {
public:
    using Value = Environment;
    EnvironmentLoad(Engine& engine, DocumentEnvironment const& environment);
    LoadState poll(size_t sliceBytes);
    LoadState state() const;
    Result<Environment> take(Engine&) { return mTicket.take(); }
    void abandon(Abandoned&) {}

private:
    LoadTicket<Environment> mTicket;
};

class LookLoad {
public:
    using Value = std::shared_ptr<const Look>;
    LookLoad(Engine& engine, std::filesystem::path const& file);
    LoadState poll(size_t) { return state(); }
    LoadState state() const { return { .step = "decoding", .isFinished = mWork.isFinished() }; }
    Result<Value> take(Engine&) { return mWork.take(); }
    void abandon(Abandoned& abandoned) { abandoned.add(mWork); }

private:
    Background<Result<Value>> mWork;
};

class DirtLoad {
public:
    using Value = Owned<Texture>;
    DirtLoad(Engine& engine, std::filesystem::path const& file);
    LoadState poll(size_t) { return state(); }
    LoadState state() const { return { .step = "decoding", .isFinished = mWork.isFinished() }; }
    Result<Value> take(Engine& engine);
    void abandon(Abandoned& abandoned) { abandoned.add(mWork); }

private:
    std::filesystem::path mFile;
    Background<Result<assets::Image>> mWork;
};

/// A file of the document: what is asked for, what is there, and the load in between.
template <class Load, class Key>
class Slot {
public:
    /// Begins to load what is asked for, if that is something else, or again. Returns the value that is no longer asked
    /// for, if nothing is: it lives until nothing shows it any more.
    std::optional<typename Load::Value> want(Engine& engine, Key const& key, bool isThere, bool again,
                                             Abandoned& abandoned) {
        if (mWanted && *mWanted == key && !again) return std::nullopt;
        drop(abandoned);
        mWanted = key;
        const bool isKept = mValue && mShown == mWanted && !again; // asked for before another one that never came
        if (isKept) return std::nullopt;
        if (!isThere) {
            mShown = key;
            return std::exchange(mValue, std::nullopt);
        }
        mLoad.emplace(engine, key);
        return std::nullopt;
    }
    /// The result of a load that is finished.
    std::optional<Result<typename Load::Value>> poll(Engine& engine, size_t sliceBytes) {
        if (!mLoad || !mLoad->poll(sliceBytes).isFinished) return std::nullopt;
        Result<typename Load::Value> result = mLoad->take(engine);
        mLoad.reset();
        if (result) mShown = mWanted;
        return result;
    }
    void drop(Abandoned& abandoned) {
        if (mLoad) mLoad->abandon(abandoned);
        mLoad.reset();
    }
    bool isLoading() const { return mLoad.has_value(); }
    std::optional<LoadState> state() const { return mLoad ? std::optional(mLoad->state()) : std::nullopt; }
    /// What is there is what is asked for.
    bool isCurrent() const { return mWanted && mShown && *mWanted == *mShown; }

    std::optional<typename Load::Value>& value() { return mValue; }
    std::optional<typename Load::Value> const& value() const { return mValue; }

private:
    std::optional<Key> mWanted, mShown;
    std::optional<Load> mLoad;
    std::optional<typename Load::Value> mValue;
};

} // namespace filament_core::view
