// SPDX-License-Identifier: Apache-2.0
/// Edits: what the defects are made of, and their tables by subject. Mutations.cpp joins those.
///   Thread  that of a StreamEdit: the driver's.
#pragma once

#include "shaders/interface/ShaderInterface.h"
#include "toolkit/mutations/Mutations.h"

#include <cmath>
#include <cstring>
#include <deque>
#include <memory>
#include <set>

namespace filament_core::tools {

using namespace backend;

using Bytes = std::vector<std::byte>;

inline float readFloat(Bytes const& bytes, size_t at) {
    float value;
    std::memcpy(&value, bytes.data() + at, sizeof(value));
    return value;
}
inline void writeFloat(Bytes& bytes, size_t at, float value) { std::memcpy(bytes.data() + at, &value, sizeof(value)); }

/// Memory for changed payloads, valid until the next stream.
class PayloadEdit : public StreamEdit {
public:
    void inspect(CommandView) override { mPayloads.clear(); }

protected:
    Bytes& copy(std::span<const std::byte>& bytes) {
        Bytes& own = mPayloads.emplace_back(bytes.begin(), bytes.end());
        bytes = own;
        return own;
    }

private:
    std::deque<Bytes> mPayloads; // grows without moving its elements
};

/// Changes values of specialization constants.
class ConstantEdit : public StreamEdit {
public:
    using StreamEdit::edit;
    void inspect(CommandView) override { mChanged.clear(); }
    void edit(CmdCreateProgram& command) override {
        auto& constants = mChanged.emplace_back(command.desc.constants.begin(), command.desc.constants.end());
        for (ConstantValue& constant : constants) editConstant(command.desc.debugName, constant);
        command.desc.constants = constants;
    }

protected:
    /// `program`: its name, with the values of the constants in full-screen materials: "fxaa/0/0/0".
    virtual void editConstant(std::string_view program, ConstantValue& constant) const = 0;

private:
    std::deque<std::vector<ConstantValue>> mChanged; // grows without moving its elements
};

/// Changes values in the uniform data of a frame.
class FrameEdit : public PayloadEdit {
public:
    void inspect(CommandView commands) override {
        PayloadEdit::inspect(commands);
        mHasLights = false;
        replay(commands, *this);
    }

    template <class C>
    void execute(C const&) {}
    void execute(CmdCreateBuffer const& command) {
        if (command.desc.debugName == "frame") mFrames.insert(command.handle);
        if (command.desc.debugName == "lights") mLights.insert(command.handle);
        if (command.desc.debugName == "froxels") mFroxels.insert(command.handle);
    }
    void execute(CmdUpdateBuffer const& command) { mHasLights = mHasLights || mLights.contains(command.buffer); }

    using PayloadEdit::edit;
    void edit(CmdUpdateBuffer& command) override {
        if (mFrames.contains(command.buffer)) changeFrame(command);
        if (mLights.contains(command.buffer)) {
            if (isOfImages(command))
                changeImages(command);
            else
                changeLights(command);
        }
        if (mFroxels.contains(command.buffer)) changeFroxels(command);
    }

protected:
    virtual void changeFrame(CmdUpdateBuffer&) {}
    virtual void changeLights(CmdUpdateBuffer&) {}
    virtual void changeFroxels(CmdUpdateBuffer&) {}
    /// Of shader::ImagedLight.
    virtual void changeImages(CmdUpdateBuffer&) {}
    bool hasLights() const { return mHasLights; }

private:
    /// They come first, and the first table lies at the first word for tables.
    static bool isOfImages(CmdUpdateBuffer const& command) {
        shader::ImagedLight first{};
        if (command.offset != 0 || command.bytes.size() < sizeof(first)) return false;
        std::memcpy(&first, command.bytes.data(), sizeof(first));
        return first.offset.x == float{ shader::kFirstImageWord };
    }

    std::set<BufferHandle> mFrames, mLights, mFroxels;
    bool mHasLights = false;
};

/// Edits what is written to the buffers of one debug name.
class NamedBufferEdit : public PayloadEdit {
public:
    explicit NamedBufferEdit(std::string_view name) : mName(name) {}

    void inspect(CommandView commands) override {
        PayloadEdit::inspect(commands);
        replay(commands, *this);
    }
    template <class C>
    void execute(C const&) {}
    void execute(CmdCreateBuffer const& command) {
        if (command.desc.debugName == mName) mBuffers.insert(command.handle);
    }

    using PayloadEdit::edit;
    void edit(CmdUpdateBuffer& command) final {
        if (mBuffers.contains(command.buffer)) editBuffer(command);
    }

private:
    virtual void editBuffer(CmdUpdateBuffer& command) = 0;

    std::string_view mName;
    std::set<BufferHandle> mBuffers;
};

/// Edits the blocks of PassUniforms and of the materials of full-screen passes.
class PassBlocksEdit : public NamedBufferEdit {
public:
    PassBlocksEdit() : NamedBufferEdit("pass blocks") {}

private:
    void editBuffer(CmdUpdateBuffer& command) final { editBlocks(copy(command.bytes)); }
    virtual void editBlocks(Bytes& bytes) = 0;
};

/// Samples a pixel of the PassUniforms that begin here with the size of a target and its reciprocal; 0: none do.
inline float samplesAt(Bytes const& bytes, size_t at) {
    const auto number = [&](size_t i) { return readFloat(bytes, at + i * sizeof(float)); };
    const auto isReciprocal = [&](size_t i) { return std::abs(number(i) * number(i + 2) - 1) < 1e-5f; };
    const bool isTarget = number(0) >= 1 && isReciprocal(0) && isReciprocal(1);
    return isTarget && (number(4) == 1 || number(4) == 4) ? number(4) : 0;
}

/// Turns a switch of a full-screen material over.
class SwitchEdit final : public ConstantEdit {
public:
    /// `constant`: its place among those of the .mat file.
    SwitchEdit(std::string_view material, uint32_t constant) : mMaterial(material), mConstant(constant) {}

private:
    void editConstant(std::string_view program, ConstantValue& constant) const override {
        if (program.substr(0, program.find('/')) == mMaterial && constant.id == mConstant) constant.bits ^= 1;
    }

    std::string_view mMaterial;
    uint32_t mConstant;
};

template <class E>
std::unique_ptr<StreamEdit> make() {
    return std::make_unique<E>();
}

std::span<const Mutation> materialMutations();
std::span<const Mutation> textureMutations();
std::span<const Mutation> lightMutations();
std::span<const Mutation> rasterMutations();
std::span<const Mutation> effectMutations();
std::span<const Mutation> splatMutations();

} // namespace filament_core::tools
