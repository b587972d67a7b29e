// SPDX-License-Identifier: Apache-2.0
/// toText(), toGraphviz(): what compile() decided and why, for people.
///   Out     toText: one line a pass (runs or culled, merged or not, and why), one line an attachment (load and store),
///           one line a texture (size, lifetime, which others share its memory).
///           toGraphviz: for `dot -Tsvg`; passes are boxes, textures ellipses; merged passes share a frame, culled
///           ones are dashed.
///   Thread  one, while graph and plan live.  Memory: the returned string.
#pragma once

#include "framegraph/CompiledGraph.h"

#include <string>

namespace filament::framegraph {

std::string toText(CompiledGraph const& plan);
std::string toGraphviz(CompiledGraph const& plan);

} // namespace filament::framegraph
