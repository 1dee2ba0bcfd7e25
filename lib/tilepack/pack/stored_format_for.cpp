#include "tilepack/pack/stored_format_for.h"

namespace tilepack {
namespace {

Depth stored_depth(Depth depth, const StorageRequest& request, StoredFor reader) {
  if (request.depth) return *request.depth;
  if (!request.container || holds(*request.container, depth)) return depth;
  if (!is_integer(depth)) return Depth::u16;
  return depth == Depth::u16 && reader == StoredFor::picture ? Depth::f32 : Depth::f16;
}

} // namespace

StoredFormat stored_format_for(Role role, Encoding encoding, Depth depth, const StorageRequest& request,
                               StoredFor reader) {
  StoredFormat format;
  format.depth = stored_depth(depth, request, reader);
  format.container = request.container.value_or(usual_container(format.depth));
  format.encoding = encoding;
  if (is_light(role) && is_integer(depth) != is_integer(format.depth))
    format.encoding = is_integer(format.depth) ? Encoding::srgb : Encoding::linear;
  if (reader == StoredFor::picture && format.container == ImageContainer::exr)
    format.encoding = Encoding::linear;
  format.associated_alpha = reader == StoredFor::picture && format.container == ImageContainer::exr;
  return format;
}

} // namespace tilepack
