// The pictures of the stages: what is drawn where, and what happens when it cannot be written.
#include <cairo.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "drawings.h"
#include "pictures/canvas.h"
#include "pictures/stage_pictures.h"
#include "pictures/streamlines.h"

namespace inkgrid {
namespace {

namespace fs = std::filesystem;

// A directory of its own, removed at the end.
struct Scratch {
  fs::path path = fs::temp_directory_path() / ("inkgrid-pictures-" + std::to_string(::getpid()));
  Scratch() { fs::create_directories(path); }
  ~Scratch() { fs::remove_all(path); }
};

struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> rgb;
  std::uint32_t at(int x, int y) const { return rgb[static_cast<std::size_t>(y * width + x)]; }
};

Picture read_png(const fs::path& path) {
  cairo_surface_t* surface = cairo_image_surface_create_from_png(path.c_str());
  Picture picture{cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), {}};
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      picture.rgb.push_back(reinterpret_cast<const std::uint32_t*>(data + y * stride)[x] & 0xffffff);
  cairo_surface_destroy(surface);
  return picture;
}

long count_colour(const Picture& picture, std::uint32_t rgb) {
  return std::count(picture.rgb.begin(), picture.rgb.end(), rgb);
}

// A horizontal stroke, and the same slimmed, with a slit.
void set_ink(Stages& stages, const Image& image) {
  stages.ink.mask = Raster<std::uint8_t>(image.width, image.height);
  stages.ink.rise = Raster<float>(image.width, image.height);
  for (int x = 8; x < 32; ++x)
    for (int y = 18; y < 22; ++y) {
      stages.ink.mask(x, y) = 1;
      stages.ink.rise(x, y) = 1 - static_cast<float>(std::abs(y + 0.5 - 20) / 4);
    }
  stages.ink.stroke_width = 4;
  stages.slim.mask = stages.ink.mask;
  stages.bundles.slits = Raster<std::uint8_t>(image.width, image.height);
  stages.bundles.count = 1;
  for (int x = 0; x < image.width; ++x) {
    stages.slim.mask(x, 18) = 0;
    stages.slim.mask(x, 21) = stages.bundles.slits(x, 21) = x >= 24 && x < 32;
    stages.bundles.slits(x, 23) = 1;
  }
}

// Two triangles around it, 24 x 16 px.
void set_mesh(Stages& stages) {
  stages.mesh.points = {{8, 12}, {32, 12}, {32, 28}, {8, 28}};
  stages.mesh.faces = {{0, 1, 2}, {0, 2, 3}};
  stages.mesh.twins = {-1, -1, 3, 2, -1, -1};
  stages.mesh.component = {0, 0};
  stages.mesh.scale = {1, 1};
  stages.mesh.on_ink = {1, 1};
  stages.mesh.components = 1;
  stages.charts.s = {{1, 0}, {1, 0}};
  stages.charts.t = {{0, 1}, {0, 1}};
  stages.charts.turns = std::vector<std::uint8_t>(6, 0);
  stages.charts.cut = {0, 0, 1, 1, 0, 0};
  stages.charts.singular = {0, 0, 1, 0};
  stages.labels = {Label::along_s, Label::along_t};
}

void set_curves(Stages& stages) {
  stages.graph.nodes = {{{16, 20}, NodeKind::grid, 1}, {{32, 20}, NodeKind::boundary, 0}};
  GraphEdge edge;
  edge.from = 0;
  edge.to = 1;
  edge.path = {{16, 20}, {20, 20}, {32, 20}};
  edge.faces = {1, 0};
  edge.family = {0, 1};
  stages.graph.edges = {edge};
  Chain chain;
  chain.points = {{8, 20}, {32, 20}};
  chain.end_junction = 0;
  stages.chains = {{{32, 20}}, {chain}};
  Curve curve;
  curve.segments = {{{8, 20}, {16, 14}, {24, 26}, {32, 20}}};
  curve.end_junction = 0;
  stages.drawing.curves = {curve};
  stages.drawing.junctions = {{32, 20}};
}

// Everything the pictures read is set by hand.
Stages square_stages(const Image& image) {
  Stages stages;
  set_ink(stages, image);
  set_mesh(stages);
  set_curves(stages);
  return stages;
}

const char* const kFiles[] = {"1-ink.png",    "2-strokes.png", "3-band.png",   "4-field.png",
                              "5-labels.png", "6-grid.png",    "7-chains.png", "8-curves.png"};

class StagePictures : public ::testing::Test {
 protected:
  Scratch scratch_;
  Image image_ = testing::blank(40, 40);
  std::map<std::string, Picture> pictures_;

  void SetUp() override {
    testing::paint(image_, {{8, 20}, {32, 20}}, 4);
    write_stage_pictures((scratch_.path / "made" / "here").string(), image_, square_stages(image_));
    for (const char* file : kFiles) pictures_[file] = read_png(scratch_.path / "made" / "here" / file);
  }
};

TEST_F(StagePictures, AreWholeMultiplesOfTheDrawingAndNothingElseIsLeftBehind) {
  for (const char* file : kFiles) {
    EXPECT_EQ(pictures_[file].width, 640) << file;
    EXPECT_EQ(pictures_[file].height, 640) << file;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch_.path / "made" / "here"), fs::directory_iterator()), std::ssize(kFiles));
}

TEST_F(StagePictures, DifferFromOneAnotherAndFromTheLightenedDrawing) {
  Canvas empty(image_, false);
  empty.write_png((scratch_.path / "empty.png").string());
  pictures_["empty"] = read_png(scratch_.path / "empty.png");
  for (auto a = pictures_.begin(); a != pictures_.end(); ++a)
    for (auto b = std::next(a); b != pictures_.end(); ++b) EXPECT_NE(a->second.rgb, b->second.rgb) << a->first << " " << b->first;
}

// The corner pixel (x, y) of the drawing is the middle of the block of 16 x 16 picture pixels at (16 x, 16 y).
TEST_F(StagePictures, PutThingsWhereTheyAre) {
  const auto colour = [&](const char* file, double x, double y) {
    return pictures_[file].at(static_cast<int>(16 * x), static_cast<int>(16 * y));
  };
  EXPECT_EQ(colour("1-ink.png", 12.5, 18.2), 0x2b5fa8u);
  EXPECT_EQ(colour("1-ink.png", 12.5, 19.8), 0xffc83du);
  EXPECT_EQ(colour("1-ink.png", 12.5, 16), 0xffffffu);
  EXPECT_EQ(colour("2-strokes.png", 12.5, 18.2), 0xb4c6e2u) << "drawn";
  EXPECT_EQ(colour("2-strokes.png", 12.5, 19.8), 0x2b5fa8u) << "left of it";
  EXPECT_EQ(colour("2-strokes.png", 28.5, 21.5), 0xf08a24u) << "a slit that is joined";
  EXPECT_EQ(colour("2-strokes.png", 28.5, 23.5), 0xffffffu) << "one that stays open";
  EXPECT_EQ(colour("5-labels.png", 20, 20), 0xff8c00u) << "the cut, on the diagonal";
  EXPECT_EQ(colour("5-labels.png", 32, 28), 0xe02020u) << "the singular vertex";
  EXPECT_NE(colour("5-labels.png", 28, 14), colour("5-labels.png", 12, 26)) << "two labels";
  EXPECT_EQ(colour("6-grid.png", 18, 20), 0xd7301fu) << "u isoline";
  EXPECT_EQ(colour("6-grid.png", 26, 20), 0x2166acu) << "v isoline";
  EXPECT_EQ(colour("7-chains.png", 20, 20), 0x1f77b4u);
  EXPECT_EQ(colour("8-curves.png", 16, 14), 0x0a7d5cu) << "a control point";
  EXPECT_EQ(colour("8-curves.png", 32, 20), 0xe02020u) << "the junction";
}

// The ink of a fine pen has pixels of its own, half as large; chains and curves are in those of the drawing.
TEST_F(StagePictures, AreTheSameOfAnEnlargedPicture) {
  Stages stages = square_stages(image_);
  const auto enlarge = [](auto& raster) {
    std::decay_t<decltype(raster)> large(2 * raster.width, 2 * raster.height);
    for (int y = 0; y < large.height; ++y)
      for (int x = 0; x < large.width; ++x) large(x, y) = raster(x / 2, y / 2);
    raster = large;
  };
  enlarge(stages.ink.mask);
  enlarge(stages.ink.rise);
  if (!stages.slim.mask.data.empty()) enlarge(stages.slim.mask);
  if (!stages.bundles.slits.data.empty()) enlarge(stages.bundles.slits);
  stages.ink.enlargement = 2;
  stages.ink.stroke_width *= 2;
  for (Vec2& p : stages.mesh.points) p = 2 * p;
  for (GraphNode& node : stages.graph.nodes) node.position = 2 * node.position;
  for (GraphEdge& edge : stages.graph.edges)
    for (Vec2& p : edge.path) p = 2 * p;
  write_stage_pictures((scratch_.path / "large").string(), image_, stages);
  for (const char* file : kFiles) EXPECT_EQ(read_png(scratch_.path / "large" / file).rgb, pictures_[file].rgb) << file;
}

TEST_F(StagePictures, MarkFreeEndsOnly) {
  for (const char* file : {"7-chains.png", "8-curves.png"}) {
    const auto ring = [&](int x) {
      long pixels = 0;
      for (int dy = -8; dy <= 8; ++dy)
        for (int dx = -8; dx <= 8; ++dx) pixels += pictures_[file].at(16 * x + dx, 320 + dy) == 0xd81b60u;
      return pixels;
    };
    EXPECT_GT(ring(8), 10) << file;
    EXPECT_EQ(ring(32), 0) << file;
  }
}

TEST_F(StagePictures, AreTheSameBytesTwice) {
  const auto bytes = [](const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  write_stage_pictures((scratch_.path / "again").string(), image_, square_stages(image_));
  for (const char* file : kFiles)
    EXPECT_EQ(bytes(scratch_.path / "made" / "here" / file), bytes(scratch_.path / "again" / file)) << file;
}

TEST(StagePicturesOfNothing, AreTheLightenedDrawing) {
  Scratch scratch;
  const Image image = testing::blank(130, 4, 55);
  write_stage_pictures(scratch.path.string(), image, Stages{});
  for (const char* file : kFiles) {
    const Picture picture = read_png(scratch.path / file);
    EXPECT_EQ(picture.width, 1950) << file;
    EXPECT_EQ(count_colour(picture, 0xc3c3c3), 1950 * 60) << file << ": 255 - 0.3 * 200 = 195";
  }
}

TEST(StagePicturesOfLightOnDark, AreTurnedOver) {
  Scratch scratch;
  Stages stages;
  stages.ink.inverted = true;
  write_stage_pictures(scratch.path.string(), testing::blank(10, 10, 0), stages);
  EXPECT_EQ(count_colour(read_png(scratch.path / "8-curves.png"), 0xffffff), 160 * 160);
}

TEST(StagePicturesThatCannotBeWritten, SaySo) {
  Scratch scratch;
  std::ofstream(scratch.path / "file") << "no directory";
  fs::create_directories(scratch.path / "taken" / "4-field.png" / "inside");
  for (const char* directory : {"file", "file/below", "taken"}) try {
      write_stage_pictures((scratch.path / directory).string(), testing::blank(10, 10), Stages{});
      ADD_FAILURE() << directory;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::file);
      EXPECT_NE(std::string(error.what()).find(directory), std::string::npos);
    }
  EXPECT_FALSE(fs::exists(scratch.path / "taken" / "4-field.png.part")) << "nothing half-written";
}

TEST(PictureScale, IsWholeForSmallDrawingsAndOneOverWholeForLargeOnes) {
  EXPECT_EQ(picture_scale(1, 1), 16);
  EXPECT_EQ(picture_scale(700, 500), 3);
  EXPECT_EQ(picture_scale(500, 1400), 1);
  EXPECT_EQ(picture_scale(4000, 10), 1);
  EXPECT_EQ(picture_scale(20000, 1), 0.2);
  for (int side = 1; side < 40000; side += 7) {
    const double scale = picture_scale(side, 1), step = scale >= 1 ? scale : 1 / scale;
    EXPECT_EQ(step, std::round(step));
    EXPECT_LE(side * scale, 4000);
  }
}

TEST(LongStrip, FitsIntoAPicture) {
  Scratch scratch;
  write_stage_pictures(scratch.path.string(), testing::blank(20000, 3), Stages{});
  EXPECT_EQ(read_png(scratch.path / "3-band.png").width, 4000);
  EXPECT_EQ(read_png(scratch.path / "3-band.png").height, 1);
}

// A strip of squares, each of two triangles, from (0, 0) to (cells, 1).
BandMesh strip(int cells) {
  BandMesh mesh;
  for (int i = 0; i <= cells; ++i) {
    mesh.points.push_back({static_cast<double>(i), 0});
    mesh.points.push_back({static_cast<double>(i), 1});
  }
  for (int i = 0; i < cells; ++i) {
    mesh.faces.push_back({2 * i, 2 * i + 2, 2 * i + 1});
    mesh.faces.push_back({2 * i + 1, 2 * i + 2, 2 * i + 3});
    const int first = 6 * i;
    mesh.twins.insert(mesh.twins.end(), {-1, first + 3, i > 0 ? first - 2 : -1, first + 1, i + 1 < cells ? first + 8 : -1, -1});
  }
  return mesh;
}

TEST(Streamlines, AreStraightInAConstantFieldWhateverTheCharts) {
  const int cells = 40;
  const BandMesh mesh = strip(cells);
  Charts charts;
  for (int f = 0; f < mesh.face_count(); ++f) {  // each face in a chart of its own
    charts.s.push_back(turned(Vec2{1, 0}, f));
    charts.t.push_back(turned(Vec2{0, 1}, f));
  }
  const auto lines = spread_streamlines(mesh, charts, {100, 0.5});
  double longest = 0;
  for (const Streamline& line : lines) {
    const Vec2 chord = line.points.back() - line.points.front();
    for (const Vec2 p : line.points) {
      EXPECT_NEAR(cross(unit(chord), p - line.points.front()), 0, 1e-9);
      EXPECT_TRUE(p.x > -1e-9 && p.x < cells + 1e-9 && p.y > -1e-9 && p.y < 1 + 1e-9);
    }
    longest = std::max(longest, norm(chord));
  }
  EXPECT_NEAR(longest, cells, 1e-9) << "through all triangles, from end to end";
}

TEST(Streamlines, EndAtTheirLengthAndKeepApart) {
  const BandMesh mesh = strip(40);
  Charts charts;
  charts.s.assign(80, {1, 0});
  charts.t.assign(80, {0, 1});
  const auto lines = spread_streamlines(mesh, charts, {3, 0.25});
  ASSERT_FALSE(lines.empty());
  std::map<int, std::vector<const Streamline*>> rows;
  for (const Streamline& line : lines) {
    EXPECT_LE(norm(line.points.back() - line.points.front()), 6 + 1e-9);
    if (line.along_s) rows[static_cast<int>(line.points.front().y / 0.25)].push_back(&line);
  }
  for (const auto& [row, members] : rows)
    for (const Streamline* a : members)
      for (const Streamline* b : members) {
        if (a >= b) continue;
        const auto span = [](const Streamline* l) { return std::minmax(l->points.front().x, l->points.back().x); };
        EXPECT_LT(std::min(span(a).second, span(b).second) - std::max(span(a).first, span(b).first), 1 + 1e-9)
            << "one triangle at most";
      }
}

}  // namespace
}  // namespace inkgrid
