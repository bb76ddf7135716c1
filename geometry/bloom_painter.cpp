#include "geometry/bloom_painter.h"

#include <algorithm>
#include <cmath>

#include "core/scalar.h"
#include "geometry/texture_colour.h"

namespace bosquet::geometry {
namespace {

// Petals and berries are brighter than leaves by what a photograph shows; none is whiter than this.
constexpr float kBloomAlbedo = 0.85f;
constexpr float kGoldenAngle_deg = 137.508f;

Vec2 heading(float angle_deg) {
  const SinCos a = sin_cos(radians(angle_deg));
  return {a.sin, a.cos};
}

// Half the width of a head of `count` small parts, and of a cone over its length.
float head_radius(const Bloom& b) { return 0.58f * std::sqrt(static_cast<float>(b.count)) * 0.001f * b.size_mm; }
float slenderness(const Bloom& b) { return std::clamp(36.0f / b.size_mm, 0.27f, 0.95f); }

class BunchPainter {
 public:
  BunchPainter(AtlasCanvas& canvas, RandomStream& stream, const Bloom& bloom, const Vec3& stalk)
      : canvas_(canvas),
        stream_(stream),
        bloom_(bloom),
        size_(0.001f * bloom.size_mm),
        colour_(kBloomAlbedo * linear_from_srgb(bloom.colour)),
        heart_(kBloomAlbedo * linear_from_srgb(bloom.heart)),
        stalk_(stalk) {}

  void paint(Vec2 node, float angle) {
    switch (bloom_.form) {
      case BloomForm::none:
        return;
      case BloomForm::blossom:
        return each(node, angle, 50.0f, 1.25f, [&](Vec2 at, float turn) { flower(at, turn); });
      case BloomForm::corymb:
        return corymb(node, angle);
      case BloomForm::tuft:
        return tuft(node, angle);
      case BloomForm::catkin:
        for (int k = 0; k < bloom_.count; ++k) catkin(node, angle + spread(18.0f));
        return;
      case BloomForm::balls:
        return string_of_balls(node, angle);
      case BloomForm::keys:
        return each(node, angle, 60.0f, 0.9f, [&](Vec2 at, float turn) { keys(at, turn); });
      case BloomForm::bracts:
        return bract(node, angle);
      case BloomForm::nuts:
      case BloomForm::drupes:
        return each(node, angle, 34.0f, 1.5f, [&](Vec2 at, float turn) { drupe(at, turn); });
      case BloomForm::cones:
        for (int k = 0; k < bloom_.count; ++k) cone(node, angle + (k == 0 ? 0.0f : spread(40.0f)));
        return;
    }
  }

 private:
  float spread(float x) { return stream_.uniform(-x, x); }
  float thin() const { return std::max(0.0004f, 0.025f * size_); }
  Vec3 varied(const Vec3& c) { return c * stream_.uniform(0.80f, 1.04f); }

  // `count` organs at the ends of stalks that fan out, the outermost first.
  template <class Organ>
  void each(Vec2 node, float angle, float fan, float stalk, Organ organ) {
    const int n = bloom_.count;
    for (int k = 0; k < n; ++k) {
      const float place = n > 1 ? static_cast<float>((k * 7) % n) / static_cast<float>(n - 1) * 2.0f - 1.0f : 0.0f;
      const float turn = angle + fan * place + spread(9.0f);
      const Vec2 at = node + heading(turn) * (stalk * size_ * stream_.uniform(0.65f, 1.0f));
      canvas_.rod(node, at, thin(), thin(), stalk_, stalk_);
      organ(at, turn);
    }
  }

  // Five petals seen from in front, or some of them from the side.
  void flower(Vec2 at, float turn) {
    const bool side = stream_.uniform() < 0.3f;
    const float first = spread(180.0f), radius = 0.5f * size_ * stream_.uniform(0.88f, 1.0f);
    const int petals = side ? 3 : 5;
    for (int p = 0; p < petals; ++p) {
      const float a =
          side ? turn + 42.0f * (static_cast<float>(p) - 1.0f) : first + 72.0f * static_cast<float>(p) + spread(6.0f);
      canvas_.petal(at, at + heading(a) * radius, 0.86f * radius, varied(colour_), 0.85f * colour_);
    }
    if (side) return;
    canvas_.ball(at, 0.16f * radius, 0.7f * heart_);
    for (int s = 0; s < 9; ++s) {
      const Vec2 tip = at + heading(first + 40.0f * static_cast<float>(s)) * (radius * stream_.uniform(0.25f, 0.45f));
      canvas_.ball(tip, 0.055f * radius, heart_);
    }
  }

  // A flat head: stalks that fork, on them berries or flowers side by side.
  void corymb(Vec2 node, float angle) {
    const float radius = head_radius(bloom_);
    const Vec2 middle = node + heading(angle) * (1.05f * radius);
    const int rays = 6;
    for (int k = 0; k < rays; ++k) {
      const float a = angle + 50.0f * (2.0f * static_cast<float>(k) / static_cast<float>(rays - 1) - 1.0f);
      canvas_.rod(node, node + heading(a) * (1.1f * radius), 1.6f * thin(), thin(), stalk_, stalk_);
    }
    for (int k = bloom_.count; k-- > 0;) {
      const float r = radius * std::sqrt((static_cast<float>(k) + 0.5f) / static_cast<float>(bloom_.count));
      const Vec2 out =
          heading(kGoldenAngle_deg * static_cast<float>(k)) * (0.86f * r) + Vec2(spread(0.2f), spread(0.2f)) * size_;
      // The dome's rim is turned away and darker.
      const float rim = r / radius, light = 1.0f - 0.30f * rim * rim;
      canvas_.ball(middle + out, 0.5f * size_ * stream_.uniform(0.85f, 1.0f), light * varied(colour_));
      canvas_.ball(middle + out + Vec2(0.03f, 0.05f) * size_, 0.13f * size_, light * heart_);
    }
  }

  void tuft(Vec2 node, float angle) {
    const float radius = head_radius(bloom_);
    const Vec2 middle = node + heading(angle) * (1.05f * radius);
    for (int k = 0; k < bloom_.count; ++k) {
      const Vec2 at = middle + heading(spread(180.0f)) * (radius * std::sqrt(stream_.uniform()));
      canvas_.rod(node, at, thin(), thin(), stalk_, stalk_);
      canvas_.ball(at, 0.5f * size_ * stream_.uniform(0.8f, 1.0f), varied(colour_));
      if (stream_.uniform() < 0.6f) canvas_.ball(at, 0.18f * size_, heart_);
    }
  }

  // A tassel: rows of scales, a little bent.
  void catkin(Vec2 node, float angle) {
    const float length = size_ * stream_.uniform(0.7f, 1.0f), radius = std::max(0.0016f, 0.05f * size_);
    const float bend = spread(22.0f);
    const int rows = std::max(6, static_cast<int>(length / (1.3f * radius)));
    Vec2 at = node;
    for (int k = 0; k < rows; ++k) {
      const float t = static_cast<float>(k) / static_cast<float>(rows);
      const Vec2 ahead = heading(angle + bend * t), across{ahead.y, -ahead.x};
      at += ahead * (length / static_cast<float>(rows));
      const float r = radius * (1.0f - 0.45f * t * t);
      for (const float s : {-0.5f, 0.5f})
        canvas_.ball(at + across * (s * r), 0.8f * r, varied(glm::mix(colour_, heart_, 0.5f + s)));
    }
  }

  void string_of_balls(Vec2 node, float angle) {
    Vec2 at = node;
    for (int k = 0; k < bloom_.count; ++k) {
      const Vec2 ahead = heading(angle + spread(10.0f)), next = at + ahead * (1.5f * size_);
      canvas_.rod(at, next, thin(), thin(), stalk_, stalk_);
      canvas_.ball(next, 0.5f * size_, colour_);
      // Styles stick out all over.
      for (int s = 0; s < 42; ++s) {
        const Vec2 p = next + heading(kGoldenAngle_deg * static_cast<float>(s)) *
                                  (0.5f * size_ * std::sqrt((static_cast<float>(s) + 0.5f) / 40.0f));
        canvas_.ball(p, 0.035f * size_, s % 3 == 0 ? heart_ : 0.7f * colour_);
      }
      at = next;
    }
  }

  // Two nuts side by side, their wings nearly in one line.
  void keys(Vec2 at, float turn) {
    const Vec2 down = heading(turn);
    for (const float hand : {-1.0f, 1.0f}) {
      const Vec2 out = heading(turn + hand * stream_.uniform(72.0f, 88.0f));
      canvas_.petal(at, at + out * (0.5f * size_), 0.17f * size_, varied(colour_), 0.8f * colour_);
      canvas_.ball(at + out * (0.07f * size_) + down * (0.02f * size_), 0.07f * size_, heart_);
    }
  }

  // A pale leaf-like bract; from its middle a stalk with small heads.
  void bract(Vec2 node, float angle) {
    const Vec2 tip = node + heading(angle) * size_;
    canvas_.petal(node, tip, 0.24f * size_, varied(heart_), 0.85f * heart_);
    const Vec2 fork = node + heading(angle) * (0.5f * size_);
    const float away = angle + (stream_.uniform() < 0.5f ? -24.0f : 24.0f);
    const Vec2 head = fork + heading(away) * (0.42f * size_);
    canvas_.rod(fork, head, thin(), thin(), stalk_, stalk_);
    for (int k = 0; k < bloom_.count; ++k) {
      const Vec2 at = head + heading(away + spread(80.0f)) * (0.22f * size_ * stream_.uniform(0.4f, 1.0f));
      canvas_.rod(head, at, 0.8f * thin(), 0.8f * thin(), stalk_, stalk_);
      canvas_.ball(at, 0.065f * size_, varied(colour_));
    }
  }

  void drupe(Vec2 at, float turn) {
    const Vec2 ahead = heading(turn);
    const Vec3 skin = varied(colour_);
    canvas_.ball(at + ahead * (0.5f * size_), 0.5f * size_, skin);
    if (bloom_.form == BloomForm::nuts) {
      canvas_.ball(at + ahead * (0.85f * size_), 0.40f * size_, skin);
      canvas_.ball(at + ahead * (0.22f * size_), 0.52f * size_, heart_);
      return;
    }
    canvas_.ball(at + ahead * (0.03f * size_), 0.10f * size_, heart_);
    canvas_.ball(at + ahead * (0.5f * size_) + Vec2(-0.14f, 0.16f) * size_, 0.09f * size_,
                 glm::mix(skin, Vec3(0.8f), 0.5f));
  }

  // Scales in rows, each with a pale lower and a dark upper edge.
  void cone(Vec2 node, float angle) {
    const Vec2 ahead = heading(angle), across{ahead.y, -ahead.x};
    const float length = size_ * stream_.uniform(0.85f, 1.0f), width = length * slenderness(bloom_);
    const float scale = width * (slenderness(bloom_) > 0.5f ? 0.30f : 0.24f);  // from scale to scale
    const int rows = std::max(3, static_cast<int>(length / (0.62f * scale)));
    for (int k = rows; k-- > 0;) {
      const float t = (static_cast<float>(k) + 0.5f) / static_cast<float>(rows), x = 2.0f * t - 1.0f;
      const float half = 0.5f * width * std::sqrt(std::max(0.05f, 1.0f - x * x * (x < 0.0f ? 0.5f : 0.9f)));
      const Vec2 middle = node + ahead * (t * length);
      canvas_.rod(middle - across * (0.8f * half), middle + across * (0.8f * half), 0.5f * scale, 0.5f * scale,
                  0.45f * heart_, 0.45f * heart_);
      const int scales = std::max(1, static_cast<int>(2.0f * half / scale + 0.5f)) + k % 2;
      for (int s = 0; s < scales; ++s) {
        // Scales toward the rims are seen from the side: closer together and darker.
        const float place = (static_cast<float>(s) + 0.5f) / static_cast<float>(scales) * 2.0f - 1.0f;
        const float round = place * (1.35f - 0.35f * place * place);
        const Vec2 at = middle + across * (0.88f * half * std::clamp(round, -1.0f, 1.0f));
        const float light = 1.0f - 0.35f * place * place;
        canvas_.ball(at, 0.52f * scale, light * heart_);
        canvas_.ball(at + ahead * (0.06f * scale), 0.42f * scale, light * varied(colour_), 0.8f);
      }
    }
  }

  AtlasCanvas& canvas_;
  RandomStream& stream_;
  const Bloom& bloom_;
  float size_;  ///< metres
  Vec3 colour_, heart_, stalk_;
};

}  // namespace

float bunch_extent_m(const Bloom& b) {
  const float size = 0.001f * b.size_mm;
  switch (b.form) {
    case BloomForm::none:
      return 0.0f;
    case BloomForm::blossom:
      return 1.8f * size;
    case BloomForm::keys:
      return 1.5f * size;
    case BloomForm::corymb:
      return 2.1f * head_radius(b) + size;
    case BloomForm::tuft:
      return 2.1f * head_radius(b) + size;
    case BloomForm::catkin:
      return 1.05f * size + 0.002f;
    case BloomForm::balls:
      return (1.5f * static_cast<float>(b.count) + 0.6f) * size;
    case BloomForm::bracts:
      return 1.25f * size;
    case BloomForm::drupes:
    case BloomForm::nuts:
      return 2.6f * size;
    case BloomForm::cones:
      return 1.1f * size;
  }
  return size;
}

float bunch_half_width_m(const Bloom& b) {
  const float size = 0.001f * b.size_mm;
  switch (b.form) {
    case BloomForm::blossom:
    case BloomForm::keys:
      return 1.55f * size;
    case BloomForm::drupes:
    case BloomForm::nuts:
      return 1.75f * size;
    case BloomForm::corymb:
    case BloomForm::tuft:
      return head_radius(b) + size;
    case BloomForm::catkin:
      return (b.count > 1 ? 0.45f : 0.25f) * size;
    case BloomForm::bracts:
      return 0.5f * size;
    case BloomForm::none:
    case BloomForm::balls:
    case BloomForm::cones:
      break;
  }
  return 0.55f * size;
}

void paint_bunch(AtlasCanvas& canvas, RandomStream& stream, const Bloom& bloom, const Vec3& stalk, Vec2 node,
                 float angle_deg) {
  BunchPainter(canvas, stream, bloom, stalk).paint(node, angle_deg);
}

}  // namespace bosquet::geometry
