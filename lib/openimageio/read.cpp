#include "image_functions.h"

#include <OpenImageIO/imageio.h>

#include <memory>
#include <stdexcept>

namespace tilepack {
namespace {

SampleType sample_type(OIIO::TypeDesc type) {
  switch (type.basetype) {
  case OIIO::TypeDesc::UINT8:
    return SampleType::u8;
  case OIIO::TypeDesc::UINT16:
    return SampleType::u16;
  case OIIO::TypeDesc::UINT32:
    return SampleType::u32;
  case OIIO::TypeDesc::HALF:
    return SampleType::f16;
  case OIIO::TypeDesc::FLOAT:
    return SampleType::f32;
  case OIIO::TypeDesc::DOUBLE:
    return SampleType::f64;
  default:
    return SampleType::other;
  }
}

std::optional<Encoding> stated_encoding(const OIIO::ImageSpec& spec, ImageFormat format) {
  if (format == ImageFormat::exr) return Encoding::linear;
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  if (space.empty()) return {};
  // Anything but linear is near sRGB: "Gamma2.2" too.
  return OIIO::Strutil::iequals(space, "linear") ? Encoding::linear : Encoding::srgb;
}

std::vector<std::byte> profile_of(const OIIO::ImageSpec& spec) {
  const OIIO::ParamValue* profile = spec.find_attribute("ICCProfile");
  if (!profile) return {};
  const auto* data = static_cast<const std::byte*>(profile->data());
  return {data, data + profile->datasize()};
}

void add_notes(RasterInfo& info, OIIO::ImageInput& input, const OIIO::ImageSpec& spec, ImageFormat format) {
  if (format == ImageFormat::tiff && spec.alpha_channel < 0 && (spec.nchannels == 2 || spec.nchannels == 4)) {
    info.alpha_channel = spec.nchannels - 1;
    info.associated_alpha = false;
    info.alpha_is_unsaid = true;
  }
  const bool has_window = spec.full_width > 0 && spec.full_height > 0;
  if (format == ImageFormat::exr && has_window && spec.roi() != spec.roi_full())
    info.notes.push_back(OIIO::Strutil::fmt::format("has a display window of {} x {} at ({}, {}) and texels "
                                                    "of {} x {} at ({}, {}), all of which are taken; "
                                                    "crop it to what is to be seen",
                                                    spec.full_width, spec.full_height, spec.full_x,
                                                    spec.full_y, spec.width, spec.height, spec.x, spec.y));
  if (format != ImageFormat::exr && format != ImageFormat::tiff) return;
  if (const OIIO::ImageSpec second = input.spec(1, 0); second.width > 0) {
    const std::string first_name = spec.get_string_attribute("oiio:subimagename");
    const std::string name = second.get_string_attribute("oiio:subimagename");
    info.notes.push_back(OIIO::Strutil::fmt::format(
        "holds several images{}, of which the first is read; save the one that is meant alone",
        first_name.empty() ? "" : " (" + first_name + ", " + name + ", …)"));
  }
}

struct OpenFile {
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;

  void read(int top, int rows, std::span<std::byte> texels) const {
    const int first = spec.y + top, last = first + rows;
    const bool ok =
        spec.tile_width > 0
            ? input->read_tiles(0, 0, spec.x, spec.x + spec.width, first, last, spec.z, spec.z + 1, 0,
                                spec.nchannels, spec.format, texels.data())
            : input->read_scanlines(0, 0, first, last, spec.z, 0, spec.nchannels, spec.format, texels.data());
    // A decoder may report a cut file and yet call the reading a success.
    if (!ok || input->has_error()) throw std::runtime_error(input->geterror());
  }
};

} // namespace

RasterReader open_image(const std::filesystem::path& file, ImageFormat format) {
  auto opened = std::make_shared<OpenFile>();
  // By format, not by name: a TIFF called "photo.jpg" is read, and OpenImageIO's formats without a file
  // ("x.null") are out of reach.
  opened->input = OIIO::ImageInput::create(std::string(openimageio_name(format)));
  if (!opened->input) throw std::runtime_error(OIIO::geterror());
  OIIO::ImageSpec wishes;
  wishes.attribute("oiio:UnassociatedAlpha", 1); // alpha as stored
  if (!opened->input->open(file.string(), opened->spec, wishes))
    throw std::runtime_error(opened->input->geterror());

  const OIIO::ImageSpec& spec = opened->spec;
  RasterInfo info;
  info.width = spec.width;
  info.height = spec.height;
  info.depth = spec.depth;
  info.channels = spec.nchannels;
  info.deep = spec.deep;
  info.samples = sample_type(spec.format);
  info.sample_name = spec.format.c_str();
  info.encoding = stated_encoding(spec, format);
  info.channel_names = spec.channelnames;
  info.names_are_free = format == ImageFormat::exr;
  info.alpha_channel = spec.alpha_channel;
  info.associated_alpha = spec.get_int_attribute("oiio:UnassociatedAlpha") == 0;
  if (format == ImageFormat::exr)
    for (int c = 0; c < spec.nchannels; ++c)
      if (spec.channelformat(c) == OIIO::TypeDesc::UINT32) info.whole_numbers.push_back(c);
  // Decoders turn round what has up to 8 bits.
  info.white_is_zero = format == ImageFormat::tiff &&
                       spec.get_int_attribute("tiff:PhotometricInterpretation", 1) == 0 &&
                       spec.format.size() > 1;
  info.orientation = spec.get_int_attribute("Orientation", 1);
  info.profile = profile_of(spec);
  add_notes(info, *opened->input, spec, format);
  opened->input->geterror(); // that there is no second image is no fault
  info.tile_width = spec.tile_width;
  info.tile_height = spec.tile_height;
  info.strip_rows = spec.get_int_attribute("tiff:RowsPerStrip", info.strip_rows);
  return {std::move(info),
          [opened](int top, int rows, std::span<std::byte> texels) { opened->read(top, rows, texels); }};
}

} // namespace tilepack
