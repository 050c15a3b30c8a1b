// Packs to files.
#pragma once

#include <filesystem>

#include "formats/core/bytes.h"
#include "formats/core/result.h"
#include "formats/pack/pack.h"

namespace oriel {

// The bytes of a pack: the same pack gives the same bytes, whatever the threads. Floats are rounded as
// docs/notes/format.md says; encoding a decoded pack again gives the same bytes. A pack with an issue of severity
// kError (validate.h) is refused with kInvalid and the first issue's text.
Result<Bytes> encode_pack(const Pack& pack);

// The same bytes as a file: path holds either the old file or the whole new one. One encoded section is in memory at a
// time. Errors: kRuntime where encode_pack has kInvalid, kIo.
Status write_pack(const std::filesystem::path& path, const Pack& pack);

}  // namespace oriel
