// SPDX-License-Identifier: Apache-2.0
/// DispatchCache: the pipelines of the engine's compute stages (shaders/compute).
///   In      the name of the file, its layout, and the values of its specialisation constants.
///   Thread  the app thread, outside of passes.
///   Memory  made at the first use; one for each set of constants, until destroy(). Finding one allocates nothing.
///   Fails   std::bad_alloc. An unknown name is a defect of the engine and asserts.
#pragma once

#include "backend/stream/CommandStream.h"

#include <span>
#include <string_view>
#include <vector>

namespace filament_core::passes {

/// Valid as long as what it names; `name` is a literal.
struct DispatchStage {
    std::string_view name;
    backend::ProgramLayout const& layout;
    std::span<const backend::ConstantValue> constants{};
};

class DispatchCache {
public:
    /// Finds the code of a file, "fog_light.spv" or "fog_light.essl": shader::engineDispatch().
    using FindCode = std::span<const std::byte> (*)(std::string_view file);

    DispatchCache(backend::CommandStream& stream, FindCode findCode) : mStream(stream), mFindCode(findCode) {}

    /// Records creation into `setup` when the pipeline does not exist yet.
    backend::PipelineHandle pipelineFor(backend::CommandBuffer& setup, DispatchStage const& stage);
    /// For frames that are only rehearsed: makeExpected() makes what is missing.
    void expect(DispatchStage const& stage) { (void)entryOf(stage); }
    void makeExpected(backend::CommandBuffer& setup);
    void destroy(backend::CommandBuffer& commands);

private:
    struct Entry {
        std::string_view name;
        backend::ProgramLayout layout;
        std::vector<backend::ConstantValue> constants;
        backend::ProgramHandle program; ///< none: not made yet
        backend::PipelineHandle pipeline;
    };
    Entry& entryOf(DispatchStage const& stage);
    void make(backend::CommandBuffer& setup, Entry& entry);

    backend::CommandStream& mStream;
    FindCode mFindCode;
    std::vector<Entry> mEntries; // a few: searched
};

} // namespace filament_core::passes
