#pragma once

#include "sinew/session/session.h"
#include "sinew/snapshot/snapshot.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

/// A running session as bytes, and back: the scene with all edits, the world, the clock, events, grabs and traces.
/// The promises of a world's snapshot (snapshot/snapshot.h) hold for a session.
namespace sinew {

/// Bytes of a session. `from`: file of the scene, to which the paths of images and models are relative; may be empty.
std::vector<std::byte> save(const Session& session, std::string_view from = {});

/// Builds a scene from its text; images and models are beside the file `from`. Nothing where it cannot.
using SceneOpener = std::function<std::optional<Opened>(const std::string& text, const std::string& from)>;

/// The session of a snapshot; nothing and an error for anything else. Where `open` fails, error.what is empty: the
/// opener has the reason.
std::optional<Session> session_of(std::span<const std::byte> bytes, const SceneOpener& open, SnapshotError& error,
                                  const SnapshotLimits& limits = {});

} // namespace sinew
