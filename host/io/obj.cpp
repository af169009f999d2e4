// Wavefront OBJ: v, vn, f, g and o; all other statements pass unread.
#include <algorithm>
#include <limits>

#include "draft.h"
#include "scanner.h"

namespace swage {
namespace {

class ObjReader {
 public:
  ObjReader(const Input& input, Draft& draft) : input_(input), draft_(draft), scan_(input, text_begin(input)) {}

  void read() {
    while (!scan_.at_end()) {
      if (!scan_.at_line_end()) statement();
      scan_.skip_line();
    }
    end_groups();
    check_vertex_indices();
    drop_missing_normals();
    collect_groups();
  }

 private:
  /// Polygons [first, last) belong to a group.
  struct Run {
    std::string group;
    size_t first, last;
  };

  void statement() {
    offset_ = scan_.at();
    const std::string_view keyword = scan_.word();
    if (keyword == "v") return vertex();
    if (keyword == "vn") return normal();
    if (keyword == "f") return face();
    if (keyword == "g") return groups();
    if (keyword == "o") return object();
  }

  void vertex() {
    Slots slots;
    const Eigen::Vector3d position = scan_.coordinates(slots);
    add_point(draft_, add_vertex(input_, draft_, position, offset_), slots);
  }

  void normal() {
    Slots slots;
    scan_.normal(slots);
    draft_.source.normals.push_back(slots);
  }

  void face() {
    corners_.clear();
    corner_normals_.clear();
    while (!scan_.at_line_end()) corner();
    const int polygon = static_cast<int>(draft_.polygons.size());
    if (!add_polygon(input_, draft_, corners_, offset_)) return;
    for (const int n : corner_normals_) draft_.normal_users.emplace_back(n, polygon);
  }

  // v, v/t, v//n or v/t/n, where t and n may be missing though their slash is there.
  void corner() {
    const size_t begin = scan_.at();
    corners_.push_back(vertex_index(begin, scan_.leading_integer("a vertex number")));
    if (scan_.take('/')) {
      if (scan_.at_integer()) scan_.leading_integer("a texture vertex number");
      if (scan_.take('/') && scan_.at_integer()) {
        corner_normals_.push_back(normal_index(scan_.leading_integer("a normal number")));
      }
    }
    const size_t end = scan_.at();
    if (scan_.at_line_end() || scan_.at() > end) return;
    scan_.jump(begin);
    refuse(input_, begin,
           in_quotes(scan_.word()) + " is not a corner of a face, such as 1, 1/2, 1//3 or 1/2/3; mend it");
  }

  // A vertex may follow the face that names it, so indices from 1 are checked at the end.
  int vertex_index(size_t offset, long long index) const {
    const long long count = draft_.vertex_count();
    if (index == 0) refuse(input_, offset, "a face names vertex 0, but OBJ counts from 1; mend or remove the face");
    if (index > std::numeric_limits<int>::max()) {
      refuse(input_, offset, "a face names a vertex beyond 2^31; mend or remove the face");
    }
    if (index > 0) return static_cast<int>(index - 1);
    if (index < -count) {
      refuse(input_, offset,
             "a face names vertex " + std::to_string(index) + ", counted back, but only " + std::to_string(count) +
                 " stand before it; mend or remove the face");
    }
    return static_cast<int>(count + index);
  }

  // -1 where there can be no such normal.
  int normal_index(long long index) const {
    const auto count = static_cast<long long>(draft_.source.normals.size());
    if (index == 0 || index < -count || index > std::numeric_limits<int>::max()) return -1;
    return static_cast<int>(index > 0 ? index - 1 : count + index);
  }

  void groups() {
    end_groups();
    group_names_.clear();
    while (!scan_.at_line_end()) group_names_.emplace_back(scan_.word());
    if (group_names_.empty()) group_names_.emplace_back("default");
  }

  void object() {
    end_groups();
    object_name_ = scan_.rest_of_line();
  }

  void end_groups() {
    const size_t last = draft_.polygons.size();
    if (last > first_) {
      for (const std::string& name : group_names_) runs_.push_back({name, first_, last});
      if (!object_name_.empty()) runs_.push_back({object_name_, first_, last});
    }
    first_ = last;
  }

  void check_vertex_indices() const {
    const int count = draft_.vertex_count();
    for (size_t p = 0; p < draft_.polygons.size(); ++p) {
      for (const int v : draft_.polygons[p]) {
        if (v < count) continue;
        refuse(input_, draft_.polygon_offsets[p],
               "a face names vertex " + std::to_string(v + 1LL) + ", but the file has " + std::to_string(count) +
                   "; mend or remove the face");
      }
    }
  }

  void drop_missing_normals() {
    const auto count = static_cast<long long>(draft_.source.normals.size());
    int warned = -1;
    std::erase_if(draft_.normal_users, [&](const std::pair<int, int>& user) {
      const auto [normal, polygon] = user;
      if (normal >= 0 && normal < count) return false;
      if (polygon != warned) {
        draft_.warnings.add(input_, draft_.polygon_offsets[static_cast<size_t>(polygon)],
                            "a face names a normal that is not there; the corner goes without");
      }
      warned = polygon;
      return true;
    });
  }

  void collect_groups() {
    for (const Run& run : runs_) {
      std::vector<int>& vertices = draft_.groups[run.group];
      for (size_t p = run.first; p < run.last; ++p) {
        vertices.insert(vertices.end(), draft_.polygons[p].begin(), draft_.polygons[p].end());
      }
    }
    for (auto& [name, vertices] : draft_.groups) {
      std::sort(vertices.begin(), vertices.end());
      vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    }
  }

  const Input& input_;
  Draft& draft_;
  Scanner scan_;
  size_t offset_ = 0;  // Of the statement being read.
  std::vector<int> corners_, corner_normals_;
  std::vector<std::string> group_names_;
  std::string object_name_;
  size_t first_ = 0;  // Polygon since which group and object names hold.
  std::vector<Run> runs_;
};

}  // namespace

void read_obj(Input& input, Draft& draft) {
  require_text(input);
  ObjReader(input, draft).read();
}

}  // namespace swage
