#pragma once

/// Version of this source tree, by semantic versioning (semver.org). Before 1.0 a minor version may change names and file formats;
/// CHANGELOG.md tells which.
#define SINEW_VERSION "0.2.0"
