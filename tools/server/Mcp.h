// SPDX-License-Identifier: Apache-2.0
/// Mcp: tools for agents over standard input and output: JSON-RPC 2.0, a message a line (Model Context Protocol,
/// revision 2025-03-26, transport "stdio").
///   Tools   render_scene: a request of docs/server.md, answered by its image. check_scene: what is wrong with one.
///           scene_schema: the JSON schema of scene files.
///   Fails   a wrong message is answered by an error of JSON-RPC; what a tool refuses is a result with `isError`.
#pragma once

#include "tools/server/RenderService.h"

#include <istream>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>

namespace filament_core::server {

/// The answer to a message; nothing for a notification.
std::optional<std::string> answerMcp(RenderService& service, std::string_view message);
/// Until the input ends.
void serveMcp(RenderService& service, std::istream& in, std::ostream& out);

std::string base64(std::string_view bytes); ///< RFC 4648, 4

} // namespace filament_core::server
