#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringVectorAttribute.h>

#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "core/vec.h"
#include "results/image_file.h"

namespace interflect::results {

namespace {

constexpr const char* order_attribute = "interflectChannels";  // EXR sorts channels by name: this keeps their order

/// A file in memory, so that the bytes reach the disk atomically.
class MemoryStream final : public Imf::OStream {
 public:
  MemoryStream() : Imf::OStream("memory") {}
  void write(const char c[], int n) override {
    const auto count = static_cast<std::size_t>(n);
    if (bytes_.size() < at_ + count) bytes_.resize(at_ + count);
    std::memcpy(bytes_.data() + at_, c, count);
    at_ += count;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

std::string exr_name(const std::string& channel) {
  return channel == "r" || channel == "g" || channel == "b" ? std::string(1, static_cast<char>(channel[0] - 'a' + 'A'))
                                                            : channel;
}

/// @param data  where channel `c` of pixel (0, 0) is; EXR wants non-const pointers for writing too
Imf::Slice slice(float* data, std::size_t c, std::size_t channels, int width) {
  const std::size_t pixel = channels * sizeof(float);
  return {Imf::FLOAT, reinterpret_cast<char*>(data + c), pixel, pixel * static_cast<std::size_t>(width)};
}

std::vector<std::string> channel_order(const Imf::Header& header) {
  std::vector<std::string> present;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) present.emplace_back(c.name());
  const auto* kept = header.findTypedAttribute<Imf::StringVectorAttribute>(order_attribute);
  if (kept == nullptr) return present;
  std::vector<std::string> a = present, b = kept->value();
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b ? kept->value() : present;
}

}  // namespace

std::string exr_bytes(const core::Image& image) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frame;
  std::vector<float> data = image.data;
  Imf::StringVector order;
  for (std::size_t c = 0; c < image.channels.size(); ++c) {
    const std::string name = exr_name(image.channels[c]);
    if (header.channels().findChannel(name) != nullptr)
      throw core::PreconditionError("exr: two channels would have the name " + name);
    order.push_back(name);
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    frame.insert(name, slice(data.data(), c, image.channels.size(), image.width));
  }
  header.insert(order_attribute, Imf::StringVectorAttribute(order));
  MemoryStream stream;
  {
    Imf::OutputFile out(stream, header);
    out.setFrameBuffer(frame);
    out.writePixels(image.height);
  }
  return stream.take();
}

core::Image read_exr(const std::filesystem::path& file) try {
  Imf::InputFile in(file.string().c_str());
  const Imath::Box2i window = in.header().dataWindow();
  core::Image image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1, channel_order(in.header()));
  const std::size_t channels = image.channels.size();
  // The frame's pointers are to pixel (0, 0), whether it lies inside the window or not.
  const Index first = Index{window.min.y} * image.width + window.min.x;
  float* origin = image.data.data() - first * static_cast<Index>(channels);
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < channels; ++c) frame.insert(image.channels[c], slice(origin, c, channels, image.width));
  in.setFrameBuffer(frame);
  in.readPixels(window.min.y, window.max.y);
  return image;
} catch (const std::exception& problem) {
  throw core::InputError(file.string(), core::single_line(problem.what()));
}

}  // namespace interflect::results
