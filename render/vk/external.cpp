#include "render/vk/external.hpp"

#include <limits>

#include "render/vk/handles.hpp"

namespace render::vk {
namespace {

const ::vk::ImageSubresourceRange kWholeImage(::vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1);
const ::vk::ImageSubresourceLayers kOneLayer(::vk::ImageAspectFlagBits::eColor, 0, 0, 1);

void change_layout(const raii::CommandBuffer& commands, VkImage image, ::vk::ImageLayout from, ::vk::ImageLayout to,
                   ::vk::AccessFlags written, ::vk::AccessFlags read) {
  const ::vk::ImageMemoryBarrier barrier(written, read, from, to, VK_QUEUE_FAMILY_IGNORED, VK_QUEUE_FAMILY_IGNORED,
                                         image, kWholeImage);
  commands.pipelineBarrier(::vk::PipelineStageFlagBits::eAllCommands, ::vk::PipelineStageFlagBits::eAllCommands, {}, {},
                           {}, barrier);
}

void check_block(const PixelBlock& block, const ExternalImage& image) {
  const bool in_image = block.x >= 0 && block.y >= 0 && block.width > 0 && block.height > 0 &&
                        block.width <= image.width - block.x && block.height <= image.height - block.y &&
                        block.row_pixels >= block.width;
  const std::size_t pixels = static_cast<std::size_t>(block.height - 1) * static_cast<std::size_t>(block.row_pixels) +
                             static_cast<std::size_t>(block.width);
  if (!in_image || block.offset + 4 * pixels > block.from->bytes()) {
    throw std::out_of_range("a block of " + std::to_string(block.width) + "x" + std::to_string(block.height) +
                            " pixels does not fit its image or its buffer");
  }
}

::vk::BufferImageCopy copy_of(const PixelBlock& block) {
  return {block.offset,
          static_cast<std::uint32_t>(block.row_pixels),
          0,
          kOneLayer,
          {block.x, block.y, 0},
          {static_cast<std::uint32_t>(block.width), static_cast<std::uint32_t>(block.height), 1}};
}

}  // namespace

ExternalHandles external_handles(const Device& device) {
  const DeviceState& state = *device.state();
  return {*state.instance.instance, *state.physical, *state.device, state.queue_family, 0};
}

void copy_to_image(Commands& commands, std::span<const PixelBlock> blocks, const ExternalImage& to) {
  for (const PixelBlock& block : blocks) {
    check_block(block, to);
  }
  const raii::CommandBuffer& recording = commands.state()->recording();
  change_layout(recording, to.image, ::vk::ImageLayout::eUndefined, ::vk::ImageLayout::eTransferDstOptimal, {},
                ::vk::AccessFlagBits::eTransferWrite);
  for (const PixelBlock& block : blocks) {
    recording.copyBufferToImage(*block.from->state()->buffer, to.image, ::vk::ImageLayout::eTransferDstOptimal,
                                copy_of(block));
    commands.state()->kept.push_back(block.from->state());
  }
  change_layout(recording, to.image, ::vk::ImageLayout::eTransferDstOptimal, ::vk::ImageLayout::eColorAttachmentOptimal,
                ::vk::AccessFlagBits::eTransferWrite,
                ::vk::AccessFlagBits::eMemoryRead | ::vk::AccessFlagBits::eMemoryWrite);
}

void copy_from_image(Commands& commands, const ExternalImage& from, Buffer& to) {
  const PixelBlock block{.from = &to, .row_pixels = from.width, .width = from.width, .height = from.height};
  check_block(block, from);
  const raii::CommandBuffer& recording = commands.state()->recording();
  change_layout(recording, from.image, ::vk::ImageLayout::eColorAttachmentOptimal,
                ::vk::ImageLayout::eTransferSrcOptimal, ::vk::AccessFlagBits::eMemoryWrite,
                ::vk::AccessFlagBits::eTransferRead);
  recording.copyImageToBuffer(from.image, ::vk::ImageLayout::eTransferSrcOptimal, *to.state()->buffer, copy_of(block));
  commands.state()->kept.push_back(to.state());
  change_layout(recording, from.image, ::vk::ImageLayout::eTransferSrcOptimal,
                ::vk::ImageLayout::eColorAttachmentOptimal, ::vk::AccessFlagBits::eTransferRead,
                ::vk::AccessFlagBits::eMemoryRead | ::vk::AccessFlagBits::eMemoryWrite);
}

struct Submission::State {
  std::shared_ptr<DeviceState> device;
  raii::Fence done = nullptr;
  std::vector<std::shared_ptr<CommandsState>> under_way;
};

Submission::Submission(const Device& device) : state_(std::make_unique<State>()) {
  state_->device = device.state();
  guarded("making a fence", [&] { state_->done = {device.state()->device, ::vk::FenceCreateInfo()}; });
}

Submission::Submission(Submission&&) noexcept = default;

Submission::~Submission() {
  if (state_ && !state_->under_way.empty()) {
    try {
      (void)wait();
    } catch (const DeviceError&) {  // a lost device has nothing under way
    }
  }
}

void Submission::start(std::span<Commands* const> commands) {
  (void)wait();
  std::vector<::vk::CommandBuffer> buffers;
  for (Commands* each : commands) {
    if (each->state()->device != state_->device) throw std::invalid_argument("commands of another device");
    each->state()->finish();
    buffers.push_back(*each->state()->commands);
  }
  guarded("submitting to " + state_->device->name, [&] {
    ::vk::SubmitInfo info;
    info.setCommandBuffers(buffers);
    state_->device->queue.submit(info, *state_->done);
  });
  for (Commands* each : commands) state_->under_way.push_back(each->state());
}

bool Submission::is_done() const {
  return state_->under_way.empty() || state_->done.getStatus() == ::vk::Result::eSuccess;
}

std::vector<StageTime> Submission::wait() {
  std::vector<StageTime> times;
  if (state_->under_way.empty()) return times;
  const auto waited = std::exchange(state_->under_way, {});
  guarded("waiting for " + state_->device->name, [&] {
    const DeviceState& device = *state_->device;
    const auto result = device.device.waitForFences(*state_->done, VK_TRUE, std::numeric_limits<std::uint64_t>::max());
    if (result != ::vk::Result::eSuccess)
      throw DeviceError("waiting for " + device.name + ": " + ::vk::to_string(result));
    device.device.resetFences(*state_->done);
    for (const auto& commands : waited) {
      const auto more = commands->times();
      times.insert(times.end(), more.begin(), more.end());
    }
  });
  return times;
}

}  // namespace render::vk
