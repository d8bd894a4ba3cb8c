#include "plugin/descriptor_in_file.hpp"

#include "files/whole_file.hpp"
#include "plugin/refusal.hpp"

#include <elf.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string>

namespace talus {
namespace {

#if defined(__x86_64__)
constexpr Elf64_Half own_machine = EM_X86_64;
constexpr std::uint64_t moved_with_the_library = R_X86_64_RELATIVE;
#elif defined(__aarch64__)
constexpr Elf64_Half own_machine = EM_AARCH64;
constexpr std::uint64_t moved_with_the_library = R_AARCH64_RELATIVE;
#else
constexpr Elf64_Half own_machine = EM_NONE;
constexpr std::uint64_t moved_with_the_library = 0;
#endif

/// The file as tables of plain structures; whatever lies beyond its end is not there.
class Image {
 public:
  explicit Image(std::string bytes) : bytes_(std::move(bytes)) {}

  template <class Entry>
  std::optional<Entry> at(std::uint64_t offset, std::uint64_t index = 0) const {
    if (index >= bytes_.size() || offset > bytes_.size() ||
        bytes_.size() - offset < (index + 1) * sizeof(Entry))
      return std::nullopt;
    Entry entry;
    std::memcpy(&entry, bytes_.data() + offset + index * sizeof(Entry), sizeof entry);
    return entry;
  }

  bool says(std::uint64_t offset, std::string_view word) const {
    return offset < bytes_.size() && bytes_.compare(offset, word.size(), word) == 0 &&
           offset + word.size() < bytes_.size() && bytes_[offset + word.size()] == '\0';
  }

  std::string_view part(std::uint64_t offset, std::uint64_t size) const {
    return offset < bytes_.size() ? std::string_view(bytes_).substr(offset, size) : std::string_view();
  }

 private:
  std::string bytes_;
};

bool is_own_library(const Elf64_Ehdr& header) {
  return std::memcmp(header.e_ident, ELFMAG, SELFMAG) == 0 && header.e_ident[EI_CLASS] == ELFCLASS64 &&
         header.e_type == ET_DYN && header.e_machine == own_machine;
}

std::optional<Elf64_Sym> find_symbol(const Image& image, const Elf64_Ehdr& header, std::string_view name) {
  for (std::uint64_t s = 0; s < header.e_shnum; ++s) {
    const auto section = image.at<Elf64_Shdr>(header.e_shoff, s);
    if (!section || section->sh_type != SHT_DYNSYM) continue;
    const auto names = image.at<Elf64_Shdr>(header.e_shoff, section->sh_link);
    if (!names) continue;
    for (std::uint64_t i = 0; i < section->sh_size / sizeof(Elf64_Sym); ++i) {
      const auto symbol = image.at<Elf64_Sym>(section->sh_offset, i);
      if (!symbol) break;
      if (symbol->st_shndx != SHN_UNDEF && image.says(names->sh_offset + symbol->st_name, name))
        return symbol;
    }
  }
  return std::nullopt;
}

/// Bytes of the file that will stand at an address once it is loaded.
std::string_view bytes_at(const Image& image, const Elf64_Ehdr& header, std::uint64_t address,
                          std::uint64_t size) {
  for (std::uint64_t s = 0; s < header.e_phnum; ++s) {
    const auto segment = image.at<Elf64_Phdr>(header.e_phoff, s);
    if (!segment || segment->p_type != PT_LOAD || address < segment->p_vaddr) continue;
    const std::uint64_t within = address - segment->p_vaddr;
    if (within >= segment->p_filesz) continue;
    return image.part(segment->p_offset + within, std::min(size, segment->p_filesz - within));
  }
  return {};
}

/// Where the pointer that stands at an address will lead: a relocation says so, or else the place itself.
std::optional<std::uint64_t> pointer_at(const Image& image, const Elf64_Ehdr& header, std::uint64_t address) {
  for (std::uint64_t s = 0; s < header.e_shnum; ++s) {
    const auto section = image.at<Elf64_Shdr>(header.e_shoff, s);
    if (!section || section->sh_type != SHT_RELA) continue;
    for (std::uint64_t i = 0; i < section->sh_size / sizeof(Elf64_Rela); ++i) {
      const auto entry = image.at<Elf64_Rela>(section->sh_offset, i);
      if (!entry) break;
      if (entry->r_offset != address) continue;
      if (ELF64_R_TYPE(entry->r_info) != moved_with_the_library) return std::nullopt;
      return static_cast<std::uint64_t>(entry->r_addend);
    }
  }
  const std::string_view bytes = bytes_at(image, header, address, sizeof(std::uint64_t));
  std::uint64_t pointer = 0;
  if (bytes.size() == sizeof pointer) std::memcpy(&pointer, bytes.data(), sizeof pointer);
  return pointer != 0 ? std::optional(pointer) : std::nullopt;
}

std::optional<ComponentName> name_at(const Image& image, const Elf64_Ehdr& header, std::uint64_t component) {
  constexpr std::uint64_t longest = 256;
  ComponentName result{};
  const std::string_view kind =
      bytes_at(image, header, component + offsetof(Component, kind), sizeof result.kind);
  const auto name = pointer_at(image, header, component + offsetof(Component, name));
  if (kind.size() != sizeof result.kind || !name) return std::nullopt;
  std::memcpy(&result.kind, kind.data(), sizeof result.kind);
  const std::string_view text = bytes_at(image, header, *name, longest);
  const std::size_t end = text.find('\0');
  if (end == std::string_view::npos) return std::nullopt;
  result.name = text.substr(0, end);
  return result;
}

/// The descriptor in an image, of one that is shorter than ours with zeros behind.
Library bytes_of(const Image& image, const Elf64_Ehdr& header, const Elf64_Sym& symbol) {
  Library library;
  std::memset(static_cast<void*>(&library), 0, sizeof library);
  const std::string_view bytes =
      bytes_at(image, header, symbol.st_value, std::min<std::uint64_t>(symbol.st_size, sizeof library));
  std::memcpy(static_cast<void*>(&library), bytes.data(), bytes.size());
  return library;
}

}  // namespace

DescriptorInFile descriptor_in_file(const std::filesystem::path& file, std::string_view symbol) {
  const Image image(read_whole_file(file));
  DescriptorInFile result;
  const auto header = image.at<Elf64_Ehdr>(0);
  if (!header || !is_own_library(*header)) return result;
  result.is_library = true;
  const auto entry = find_symbol(image, *header, symbol);
  if (!entry) return result;
  result.has_symbol = true;
  result.bytes = bytes_of(image, *header, *entry);
  return result;
}

std::optional<std::vector<ComponentName>> components_in_file(const std::filesystem::path& file,
                                                             std::string_view symbol) {
  const Image image(read_whole_file(file));
  const auto header = image.at<Elf64_Ehdr>(0);
  if (!header || !is_own_library(*header)) return std::nullopt;
  const auto entry = find_symbol(image, *header, symbol);
  if (!entry) return std::nullopt;
  const Library library = bytes_of(image, *header, *entry);
  if (reason_in_numbers(library)) return std::nullopt;
  const auto first = pointer_at(image, *header, entry->st_value + offsetof(Library, components));
  if (!first) return std::nullopt;
  std::vector<ComponentName> names;
  for (std::uint64_t i = 0; i < library.component_count; ++i) {
    auto name = name_at(image, *header, *first + i * sizeof(Component));
    if (!name) return std::nullopt;
    names.push_back(*std::move(name));
  }
  return names;
}

}  // namespace talus
