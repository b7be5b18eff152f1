#include "base/archive.hpp"

#include "base/error.hpp"

namespace cinch {

void Archive::refuse(const std::string& name, const std::string& why) const {
  throw FileError("error: " + place() + ": " + name + " " + why);
}

void Archive::text(const std::string& name, std::string& text) {
  std::vector<std::string> list{text};
  texts(name, list);
  if (list.size() != 1) refuse(name, "is not one text");
  text = list[0];
}

std::int64_t Archive::within(const std::string& name, std::int64_t number, std::int64_t low,
                             std::int64_t high) const {
  if (number < low || number > high)
    refuse(name, "holds " + std::to_string(number) + "; allowed: " + std::to_string(low) + " to " +
                     std::to_string(high));
  return number;
}

}  // namespace cinch
