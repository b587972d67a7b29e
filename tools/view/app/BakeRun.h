// SPDX-License-Identifier: Apache-2.0
/// BakeRun: filament-bake as a child process of low priority, for the model of a document.
///   Scene    the model's file, the environment and one sun of the document. Other lights that the document adds, and
///            edits of nodes and materials, are not part of it.
///   Folder   in `out`, named by the command: the same command continues a lightmap that was cancelled or killed,
///            from its journal.
///   Cancel   kills the child. So does the destructor.
///   Thread   one.   Fails: bakeCommand() and start(): one line; a bake that fails: the last line of its log.
#pragma once

#include "toolkit/program/ChildProcess.h"
#include "tools/view/document/Document.h"
#include "tools/view/panels/ProbeModel.h"

#include <filament_core/Box.h>

#include <chrono>

namespace filament_core::view {

struct BakeRequest {
    Document document{};
    bool usesModelEnvironment = false; ///< the model's own lights it
    BakeSettings settings{};
    Box box{};                     ///< Grid: in the world
    std::filesystem::path out{};   ///< folder of the folders of bakes
    std::filesystem::path program; ///< filament-bake
};

struct BakeCommand {
    std::vector<std::string> words;     ///< of the program, then of its command line
    std::filesystem::path folder, file; ///< file: what it writes, a .glb or a .grid
    std::string grid;                   ///< JSON text of --grid; empty: a lightmap
};

/// InvalidArgument: no glTF model, an environment that cannot be traced, or a grid of a model that is fitted.
Result<BakeCommand> bakeCommand(BakeRequest const& request);

/// "  42 %  10/24 texels  3 s left" in a log: the share and the line. Nothing: no such line.
BakeProgress progressIn(std::string_view log);

/// filament-bake beside this program, or else in PATH.
std::filesystem::path bakeProgram();

/// What a bake has written.
struct BakeResult {
    BakeKind kind = BakeKind::Lightmap;
    std::filesystem::path file{};
};

class BakeRun {
public:
    Result<void> start(BakeRequest const& request);
    void cancel();
    bool isBusy() const { return mChild.has_value(); }
    /// Looks at the child and, four times a second, at its log. A result once it has ended; Cancelled after cancel().
    std::optional<Result<BakeResult>> poll();
    BakeProgress const& progress() const { return mProgress; }

private:
    std::filesystem::path log() const { return mCommand.folder / "bake.log"; }

    std::optional<tools::ChildProcess> mChild;
    BakeCommand mCommand;
    BakeKind mKind = BakeKind::Lightmap;
    BakeProgress mProgress;
    std::chrono::steady_clock::time_point mNextLook{};
    bool mIsCancelled = false;
};

} // namespace filament_core::view
