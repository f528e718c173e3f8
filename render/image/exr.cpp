#include "render/image/exr.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <half.h>

#include <algorithm>
#include <stdexcept>

#include "render/image/output_file.hpp"
#include "tracking/input_error.hpp"

namespace render {
namespace {

bool is_colour(const std::string& channel) {
  return channel == "R" || channel == "G" || channel == "B";
}

// Light brighter than a half can hold stays finite.
std::vector<half> to_half(const std::vector<float>& plane) {
  constexpr auto kMost = static_cast<float>(HALF_MAX);
  std::vector<half> values(plane.size());
  std::ranges::transform(plane, values.begin(), [&](float value) { return half(std::clamp(value, -kMost, kMost)); });
  return values;
}

// OpenEXR takes its sources through pointers to mutable memory but only reads them.
template <class T>
Imf::Slice slice_of(Imf::PixelType type, const std::vector<T>& plane, int width) {
  return {type, const_cast<char*>(reinterpret_cast<const char*>(plane.data())), sizeof(T),
          sizeof(T) * static_cast<std::size_t>(width)};
}

void write_to(const std::filesystem::path& file, const FloatImage& image) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::addChromaticities(header, Imf::Chromaticities());  // the default is Rec. 709, which sRGB shares
  Imf::FrameBuffer source;
  std::vector<std::vector<half>> halves;
  halves.reserve(image.planes.size());
  for (std::size_t i = 0; i < image.planes.size(); ++i) {
    const std::string& name = image.channels[i];
    if (is_colour(name)) {
      halves.push_back(to_half(image.planes[i]));
      header.channels().insert(name, Imf::Channel(Imf::HALF));
      source.insert(name, slice_of(Imf::HALF, halves.back(), image.width));
    } else {
      header.channels().insert(name, Imf::Channel(Imf::FLOAT));
      source.insert(name, slice_of(Imf::FLOAT, image.planes[i], image.width));
    }
  }
  Imf::OutputFile output(file.c_str(), header);
  output.setFrameBuffer(source);
  output.writePixels(image.height);
}

FloatImage read_from(const std::filesystem::path& file) {
  Imf::InputFile input(file.c_str());
  const Imath::Box2i window = input.header().dataWindow();
  FloatImage image;
  image.width = window.max.x - window.min.x + 1;
  image.height = window.max.y - window.min.y + 1;
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  for (auto channel = input.header().channels().begin(); channel != input.header().channels().end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) {
      throw std::runtime_error("channel " + std::string(channel.name()) + " is subsampled, only full ones are read");
    }
    image.channels.emplace_back(channel.name());
    image.planes.emplace_back(pixels);
  }
  Imf::FrameBuffer target;
  for (std::size_t i = 0; i < image.planes.size(); ++i) {
    target.insert(image.channels[i], Imf::Slice::Make(Imf::FLOAT, image.planes[i].data(), window));
  }
  input.setFrameBuffer(target);
  input.readPixels(window.min.y, window.max.y);
  return image;
}

}  // namespace

void write_exr(const std::filesystem::path& file, const FloatImage& image) {
  check_image(image);
  replace_file(file, [&](const std::filesystem::path& temporary) { write_to(temporary, image); });
}

FloatImage read_exr(const std::filesystem::path& file) {
  try {
    return read_from(file);
  } catch (const std::exception& error) {
    throw tracking::InputError(file.string(), "", std::string("cannot be read as OpenEXR: ") + error.what());
  }
}

}  // namespace render
