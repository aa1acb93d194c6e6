// The sections of a compiled level as columns, and their range check. Made by tools/generate.py from what
// jktools/compiler/columns.py declares, which a test holds to the schema's index_of and or_none; do not edit.
//
// A column that the file's minor version does not have has no rows. grammars/level.fbs says what each column holds.
#pragma once

#include <optional>
#include <string>

#include "columns.hpp"

namespace jklb {

// Files of this major version are read, of later minor versions what was there before.
inline constexpr unsigned kFormatMajor = 1, kFormatMinor = 3;

// The minor version that brought Level.text and the columns of omissions.
inline constexpr unsigned kTextSince = 2;

struct Text {
    Column<std::uint8_t> text;
    Column<std::uint32_t> text_start;
    Column<std::uint8_t> symbols;

    Text() = default;
    Text(const jktools::Level& table, unsigned minor)
        : text(column<std::uint8_t>(table.text(), nullptr, 1, 0)),
          text_start(column<std::uint32_t>(table.text_start(), table.text_start_packed(), 1, 0)),
          symbols(minor >= 3 ? column<std::uint8_t>(table.symbols(), nullptr, 1, 0) : Column<std::uint8_t>()) {}
};

struct Omission {
    Column<std::int32_t> source;
    Column<std::uint32_t> name_text;

    Omission() = default;
    Omission(const jktools::Omission& table, unsigned)
        : source(column<std::int32_t>(table.source(), table.source_packed(), 1, 0)),
          name_text(column<std::uint32_t>(table.name_text(), table.name_text_packed(), 1, source.rows())) {}
};

struct Resources {
    Column<std::uint32_t> sounds;
    Column<std::uint32_t> materials;
    Column<std::uint32_t> colormaps;
    Column<std::uint32_t> aiclasses;
    Column<std::uint32_t> models;
    Column<std::uint32_t> sprites;
    Column<std::uint32_t> keyframes;
    Column<std::uint32_t> animclasses;
    Column<std::uint32_t> soundclasses;
    Column<std::uint32_t> cogscripts;

    Resources() = default;
    Resources(const jktools::Resources& table, unsigned)
        : sounds(column<std::uint32_t>(table.sounds(), table.sounds_packed(), 1, 0)),
          materials(column<std::uint32_t>(table.materials(), table.materials_packed(), 1, 0)),
          colormaps(column<std::uint32_t>(table.colormaps(), table.colormaps_packed(), 1, 0)),
          aiclasses(column<std::uint32_t>(table.aiclasses(), table.aiclasses_packed(), 1, 0)),
          models(column<std::uint32_t>(table.models(), table.models_packed(), 1, 0)),
          sprites(column<std::uint32_t>(table.sprites(), table.sprites_packed(), 1, 0)),
          keyframes(column<std::uint32_t>(table.keyframes(), table.keyframes_packed(), 1, 0)),
          animclasses(column<std::uint32_t>(table.animclasses(), table.animclasses_packed(), 1, 0)),
          soundclasses(column<std::uint32_t>(table.soundclasses(), table.soundclasses_packed(), 1, 0)),
          cogscripts(column<std::uint32_t>(table.cogscripts(), table.cogscripts_packed(), 1, 0)) {}
};

struct Geometry {
    Column<float> vertices;
    Column<float> texture_vertices;
    Column<std::uint32_t> adjoin_flags;
    Column<std::uint32_t> surface_flags;
    Column<std::int32_t> corner_vertex;
    Column<float> corner_light;
    Column<std::uint32_t> sector_flags;
    Column<std::int32_t> sector_vertex;
    Column<std::int32_t> adjoin_mirror;
    Column<float> adjoin_distance;
    Column<std::int32_t> adjoin_surface;
    Column<std::int32_t> surface_material;
    Column<std::uint32_t> surface_face_flags;
    Column<std::int32_t> surface_geometry_mode;
    Column<std::int32_t> surface_light_mode;
    Column<std::int32_t> surface_texture_mode;
    Column<std::int32_t> surface_adjoin;
    Column<float> surface_extra_light;
    Column<float> surface_normal;
    Column<std::int32_t> surface_sector;
    Column<std::uint32_t> surface_corner_start;
    Column<std::int32_t> corner_texture_vertex;
    Column<std::uint32_t> surface_light_start;
    Column<float> sector_ambient_light;
    Column<float> sector_extra_light;
    Column<std::int32_t> sector_colormap;
    Column<float> sector_tint;
    Column<float> sector_bound_box;
    Column<float> sector_collide_box;
    Column<std::int32_t> sector_sound;
    Column<float> sector_sound_volume;
    Column<float> sector_center;
    Column<float> sector_radius;
    Column<std::uint32_t> sector_vertex_start;
    Column<std::int32_t> sector_first_surface;
    Column<std::int32_t> sector_surface_count;

    Geometry() = default;
    Geometry(const jktools::Geometry& table, unsigned)
        : vertices(column<float>(table.vertices(), table.vertices_packed(), 3, 0)),
          texture_vertices(column<float>(table.texture_vertices(), table.texture_vertices_packed(), 2, 0)),
          adjoin_flags(column<std::uint32_t>(table.adjoin_flags(), table.adjoin_flags_packed(), 1, 0)),
          surface_flags(column<std::uint32_t>(table.surface_flags(), table.surface_flags_packed(), 1, 0)),
          corner_vertex(column<std::int32_t>(table.corner_vertex(), table.corner_vertex_packed(), 1, 0)),
          corner_light(column<float>(table.corner_light(), table.corner_light_packed(), 1, 0)),
          sector_flags(column<std::uint32_t>(table.sector_flags(), table.sector_flags_packed(), 1, 0)),
          sector_vertex(column<std::int32_t>(table.sector_vertex(), table.sector_vertex_packed(), 1, 0)),
          adjoin_mirror(column<std::int32_t>(table.adjoin_mirror(), table.adjoin_mirror_packed(), 1, adjoin_flags.rows())),
          adjoin_distance(column<float>(table.adjoin_distance(), table.adjoin_distance_packed(), 1, adjoin_flags.rows())),
          adjoin_surface(column<std::int32_t>(table.adjoin_surface(), table.adjoin_surface_packed(), 1, adjoin_flags.rows(), -1)),
          surface_material(column<std::int32_t>(table.surface_material(), table.surface_material_packed(), 1, surface_flags.rows(), -1)),
          surface_face_flags(column<std::uint32_t>(table.surface_face_flags(), table.surface_face_flags_packed(), 1, surface_flags.rows())),
          surface_geometry_mode(column<std::int32_t>(table.surface_geometry_mode(), table.surface_geometry_mode_packed(), 1, surface_flags.rows())),
          surface_light_mode(column<std::int32_t>(table.surface_light_mode(), table.surface_light_mode_packed(), 1, surface_flags.rows())),
          surface_texture_mode(column<std::int32_t>(table.surface_texture_mode(), table.surface_texture_mode_packed(), 1, surface_flags.rows())),
          surface_adjoin(column<std::int32_t>(table.surface_adjoin(), table.surface_adjoin_packed(), 1, surface_flags.rows(), -1)),
          surface_extra_light(column<float>(table.surface_extra_light(), table.surface_extra_light_packed(), 1, surface_flags.rows())),
          surface_normal(column<float>(table.surface_normal(), table.surface_normal_packed(), 3, surface_flags.rows())),
          surface_sector(column<std::int32_t>(table.surface_sector(), table.surface_sector_packed(), 1, surface_flags.rows(), -1)),
          surface_corner_start(column<std::uint32_t>(table.surface_corner_start(), table.surface_corner_start_packed(), 1, surface_flags.rows())),
          corner_texture_vertex(column<std::int32_t>(table.corner_texture_vertex(), table.corner_texture_vertex_packed(), 1, corner_vertex.rows(), -1)),
          surface_light_start(column<std::uint32_t>(table.surface_light_start(), table.surface_light_start_packed(), 1, surface_flags.rows())),
          sector_ambient_light(column<float>(table.sector_ambient_light(), table.sector_ambient_light_packed(), 1, sector_flags.rows())),
          sector_extra_light(column<float>(table.sector_extra_light(), table.sector_extra_light_packed(), 1, sector_flags.rows())),
          sector_colormap(column<std::int32_t>(table.sector_colormap(), table.sector_colormap_packed(), 1, sector_flags.rows())),
          sector_tint(column<float>(table.sector_tint(), table.sector_tint_packed(), 3, sector_flags.rows())),
          sector_bound_box(column<float>(table.sector_bound_box(), table.sector_bound_box_packed(), 6, sector_flags.rows())),
          sector_collide_box(column<float>(table.sector_collide_box(), table.sector_collide_box_packed(), 6, sector_flags.rows())),
          sector_sound(column<std::int32_t>(table.sector_sound(), table.sector_sound_packed(), 1, sector_flags.rows(), -1)),
          sector_sound_volume(column<float>(table.sector_sound_volume(), table.sector_sound_volume_packed(), 1, sector_flags.rows())),
          sector_center(column<float>(table.sector_center(), table.sector_center_packed(), 3, sector_flags.rows())),
          sector_radius(column<float>(table.sector_radius(), table.sector_radius_packed(), 1, sector_flags.rows())),
          sector_vertex_start(column<std::uint32_t>(table.sector_vertex_start(), table.sector_vertex_start_packed(), 1, sector_flags.rows())),
          sector_first_surface(column<std::int32_t>(table.sector_first_surface(), table.sector_first_surface_packed(), 1, sector_flags.rows())),
          sector_surface_count(column<std::int32_t>(table.sector_surface_count(), table.sector_surface_count_packed(), 1, sector_flags.rows())) {}
};

struct Templates {
    Column<std::int32_t> source;
    Column<std::uint32_t> parameter_key;
    Column<std::uint32_t> value_key;
    Column<double> number;
    Column<std::uint32_t> list_start;
    Column<double> list_number;
    Column<std::uint32_t> unused_key;
    Column<std::uint32_t> own_key;
    Column<std::uint32_t> name;
    Column<std::uint32_t> parent;
    Column<std::uint32_t> parameter_start;
    Column<std::uint32_t> parameter_value;
    Column<std::int32_t> type;
    Column<std::int32_t> move;
    Column<std::int32_t> has_ai;
    Column<std::uint32_t> value_start;
    Column<std::int32_t> value_text;
    Column<std::int32_t> value_source;
    Column<std::uint32_t> number_start;
    Column<std::uint32_t> value_list;
    Column<std::uint32_t> unused_start;
    Column<std::uint32_t> unused_value;
    Column<std::int32_t> base;
    Column<std::uint32_t> own_start;
    Column<std::int32_t> own_text;
    Column<std::int32_t> own_setter;
    Column<std::uint32_t> own_list;

    Templates() = default;
    Templates(const jktools::Templates& table, unsigned minor)
        : source(column<std::int32_t>(table.source(), table.source_packed(), 1, 0)),
          parameter_key(minor <= 1 ? column<std::uint32_t>(table.parameter_key(), table.parameter_key_packed(), 1, 0) : Column<std::uint32_t>()),
          value_key(minor >= 1 && minor <= 2 ? column<std::uint32_t>(table.value_key(), table.value_key_packed(), 1, 0) : Column<std::uint32_t>()),
          number(minor >= 1 && minor <= 1 ? column<double>(table.number(), table.number_packed(), 1, 0) : Column<double>()),
          list_start(minor >= 2 ? column<std::uint32_t>(table.list_start(), table.list_start_packed(), 1, 0) : Column<std::uint32_t>()),
          list_number(minor >= 2 ? column<double>(table.list_number(), table.list_number_packed(), 1, 0) : Column<double>()),
          unused_key(minor >= 2 ? column<std::uint32_t>(table.unused_key(), table.unused_key_packed(), 1, 0) : Column<std::uint32_t>()),
          own_key(minor >= 3 ? column<std::uint32_t>(table.own_key(), table.own_key_packed(), 1, 0) : Column<std::uint32_t>()),
          name(column<std::uint32_t>(table.name(), table.name_packed(), 1, source.rows())),
          parent(column<std::uint32_t>(table.parent(), table.parent_packed(), 1, source.rows())),
          parameter_start(minor <= 1 ? column<std::uint32_t>(table.parameter_start(), table.parameter_start_packed(), 1, source.rows()) : Column<std::uint32_t>()),
          parameter_value(minor <= 1 ? column<std::uint32_t>(table.parameter_value(), table.parameter_value_packed(), 1, parameter_key.rows()) : Column<std::uint32_t>()),
          type(minor >= 1 ? column<std::int32_t>(table.type(), table.type_packed(), 1, source.rows()) : Column<std::int32_t>()),
          move(minor >= 1 ? column<std::int32_t>(table.move(), table.move_packed(), 1, source.rows()) : Column<std::int32_t>()),
          has_ai(minor >= 1 ? column<std::int32_t>(table.has_ai(), table.has_ai_packed(), 1, source.rows()) : Column<std::int32_t>()),
          value_start(minor >= 1 && minor <= 2 ? column<std::uint32_t>(table.value_start(), table.value_start_packed(), 1, source.rows()) : Column<std::uint32_t>()),
          value_text(minor >= 1 && minor <= 2 ? column<std::int32_t>(table.value_text(), table.value_text_packed(), 1, value_key.rows(), -1) : Column<std::int32_t>()),
          value_source(minor >= 1 && minor <= 2 ? column<std::int32_t>(table.value_source(), table.value_source_packed(), 1, value_key.rows()) : Column<std::int32_t>()),
          number_start(minor >= 1 && minor <= 1 ? column<std::uint32_t>(table.number_start(), table.number_start_packed(), 1, value_key.rows()) : Column<std::uint32_t>()),
          value_list(minor >= 2 && minor <= 2 ? column<std::uint32_t>(table.value_list(), table.value_list_packed(), 1, value_key.rows()) : Column<std::uint32_t>()),
          unused_start(minor >= 2 ? column<std::uint32_t>(table.unused_start(), table.unused_start_packed(), 1, source.rows()) : Column<std::uint32_t>()),
          unused_value(minor >= 2 ? column<std::uint32_t>(table.unused_value(), table.unused_value_packed(), 1, unused_key.rows()) : Column<std::uint32_t>()),
          base(minor >= 3 ? column<std::int32_t>(table.base(), table.base_packed(), 1, source.rows(), -1) : Column<std::int32_t>()),
          own_start(minor >= 3 ? column<std::uint32_t>(table.own_start(), table.own_start_packed(), 1, source.rows()) : Column<std::uint32_t>()),
          own_text(minor >= 3 ? column<std::int32_t>(table.own_text(), table.own_text_packed(), 1, own_key.rows(), -1) : Column<std::int32_t>()),
          own_setter(minor >= 3 ? column<std::int32_t>(table.own_setter(), table.own_setter_packed(), 1, own_key.rows()) : Column<std::int32_t>()),
          own_list(minor >= 3 ? column<std::uint32_t>(table.own_list(), table.own_list_packed(), 1, own_key.rows()) : Column<std::uint32_t>()) {}
};

struct Things {
    Column<std::int32_t> source;
    Column<std::uint32_t> parameter_key;
    Column<std::int32_t> number;
    Column<std::uint32_t> template_;
    Column<std::uint32_t> name;
    Column<float> position;
    Column<float> angles;
    Column<std::int32_t> sector;
    Column<std::int32_t> arch_light;
    Column<std::uint32_t> parameter_start;
    Column<std::uint32_t> parameter_value;

    Things() = default;
    Things(const jktools::Things& table, unsigned)
        : source(column<std::int32_t>(table.source(), table.source_packed(), 1, 0)),
          parameter_key(column<std::uint32_t>(table.parameter_key(), table.parameter_key_packed(), 1, 0)),
          number(column<std::int32_t>(table.number(), table.number_packed(), 1, source.rows())),
          template_(column<std::uint32_t>(table.template_(), table.template_packed(), 1, source.rows())),
          name(column<std::uint32_t>(table.name(), table.name_packed(), 1, source.rows())),
          position(column<float>(table.position(), table.position_packed(), 3, source.rows())),
          angles(column<float>(table.angles(), table.angles_packed(), 3, source.rows())),
          sector(column<std::int32_t>(table.sector(), table.sector_packed(), 1, source.rows())),
          arch_light(column<std::int32_t>(table.arch_light(), table.arch_light_packed(), 1, source.rows())),
          parameter_start(column<std::uint32_t>(table.parameter_start(), table.parameter_start_packed(), 1, source.rows())),
          parameter_value(column<std::uint32_t>(table.parameter_value(), table.parameter_value_packed(), 1, parameter_key.rows())) {}
};

struct Cogs {
    Column<std::int32_t> source;
    Column<std::uint32_t> value;
    Column<std::uint32_t> script;
    Column<std::uint32_t> value_start;

    Cogs() = default;
    Cogs(const jktools::Cogs& table, unsigned)
        : source(column<std::int32_t>(table.source(), table.source_packed(), 1, 0)),
          value(column<std::uint32_t>(table.value(), table.value_packed(), 1, 0)),
          script(column<std::uint32_t>(table.script(), table.script_packed(), 1, source.rows())),
          value_start(column<std::uint32_t>(table.value_start(), table.value_start_packed(), 1, source.rows())) {}
};

struct Visibility {
    Column<std::int32_t> sector;
    Column<std::uint8_t> row;
    Column<std::uint32_t> row_start;

    Visibility() = default;
    Visibility(const jktools::Visibility& table, unsigned)
        : sector(column<std::int32_t>(table.sector(), table.sector_packed(), 1, 0)),
          row(column<std::uint8_t>(table.row(), table.row_packed(), 1, 0)),
          row_start(column<std::uint32_t>(table.row_start(), table.row_start_packed(), 1, sector.rows())) {}
};

struct Hotspots {
    Column<std::int32_t> cog;
    Column<std::uint32_t> script;
    Column<std::uint32_t> verb;
    Column<std::int32_t> line;
    Column<std::int32_t> things;
    Column<std::uint8_t> more;
    Column<double> calls_per_second;
    Column<double> mean_sectors;
    Column<double> mean_surfaces;
    Column<std::int32_t> most_sectors;
    Column<std::int32_t> most_surfaces;
    Column<std::int32_t> pairs;
    Column<std::int32_t> verdict;

    Hotspots() = default;
    Hotspots(const jktools::Hotspots& table, unsigned)
        : cog(column<std::int32_t>(table.cog(), table.cog_packed(), 1, 0)),
          script(column<std::uint32_t>(table.script(), table.script_packed(), 1, cog.rows())),
          verb(column<std::uint32_t>(table.verb(), table.verb_packed(), 1, cog.rows())),
          line(column<std::int32_t>(table.line(), table.line_packed(), 1, cog.rows())),
          things(column<std::int32_t>(table.things(), table.things_packed(), 1, cog.rows())),
          more(column<std::uint8_t>(table.more(), table.more_packed(), 1, cog.rows())),
          calls_per_second(column<double>(table.calls_per_second(), table.calls_per_second_packed(), 1, cog.rows())),
          mean_sectors(column<double>(table.mean_sectors(), table.mean_sectors_packed(), 1, cog.rows())),
          mean_surfaces(column<double>(table.mean_surfaces(), table.mean_surfaces_packed(), 1, cog.rows())),
          most_sectors(column<std::int32_t>(table.most_sectors(), table.most_sectors_packed(), 1, cog.rows())),
          most_surfaces(column<std::int32_t>(table.most_surfaces(), table.most_surfaces_packed(), 1, cog.rows())),
          pairs(column<std::int32_t>(table.pairs(), table.pairs_packed(), 1, cog.rows())),
          verdict(column<std::int32_t>(table.verdict(), table.verdict_packed(), 1, cog.rows())) {}
};

struct Lights {
    Column<std::int32_t> thing;
    Column<std::int32_t> vertex;
    Column<float> position;
    Column<float> intensity;
    Column<float> reach;
    Column<std::uint32_t> vertex_start;
    Column<float> amount;

    Lights() = default;
    Lights(const jktools::Lights& table, unsigned)
        : thing(column<std::int32_t>(table.thing(), table.thing_packed(), 1, 0)),
          vertex(column<std::int32_t>(table.vertex(), table.vertex_packed(), 1, 0)),
          position(column<float>(table.position(), table.position_packed(), 3, thing.rows())),
          intensity(column<float>(table.intensity(), table.intensity_packed(), 1, thing.rows())),
          reach(column<float>(table.reach(), table.reach_packed(), 1, thing.rows())),
          vertex_start(column<std::uint32_t>(table.vertex_start(), table.vertex_start_packed(), 1, thing.rows())),
          amount(column<float>(table.amount(), table.amount_packed(), 1, vertex.rows())) {}
};

struct Particles {
    Column<std::int32_t> template_;
    Column<std::int32_t> material;
    Column<std::int32_t> cels;
    Column<std::int32_t> spawned;
    Column<std::int32_t> timer_ms;
    Column<std::uint32_t> flags;
    Column<float> range;
    Column<float> minsize;
    Column<std::int32_t> lost_a_step;
    Column<float> maxthrust;
    Column<float> elementsize;
    Column<float> pitchrange;
    Column<float> yawrange;
    Column<std::int32_t> light_mode;

    Particles() = default;
    Particles(const jktools::Particles& table, unsigned)
        : template_(column<std::int32_t>(table.template_(), table.template_packed(), 1, 0)),
          material(column<std::int32_t>(table.material(), table.material_packed(), 1, template_.rows(), -1)),
          cels(column<std::int32_t>(table.cels(), table.cels_packed(), 1, template_.rows())),
          spawned(column<std::int32_t>(table.spawned(), table.spawned_packed(), 1, template_.rows())),
          timer_ms(column<std::int32_t>(table.timer_ms(), table.timer_ms_packed(), 1, template_.rows())),
          flags(column<std::uint32_t>(table.flags(), table.flags_packed(), 1, template_.rows())),
          range(column<float>(table.range(), table.range_packed(), 1, template_.rows())),
          minsize(column<float>(table.minsize(), table.minsize_packed(), 1, template_.rows())),
          lost_a_step(column<std::int32_t>(table.lost_a_step(), table.lost_a_step_packed(), 1, template_.rows())),
          maxthrust(column<float>(table.maxthrust(), table.maxthrust_packed(), 1, template_.rows())),
          elementsize(column<float>(table.elementsize(), table.elementsize_packed(), 1, template_.rows())),
          pitchrange(column<float>(table.pitchrange(), table.pitchrange_packed(), 1, template_.rows())),
          yawrange(column<float>(table.yawrange(), table.yawrange_packed(), 1, template_.rows())),
          light_mode(column<std::int32_t>(table.light_mode(), table.light_mode_packed(), 1, template_.rows())) {}
};

struct ColourEffects {
    Column<std::int32_t> cog;
    Column<std::uint32_t> script;
    Column<std::int32_t> line;
    Column<double> argument;
    Column<std::int32_t> colormap;
    Column<std::uint8_t> palette;

    ColourEffects() = default;
    ColourEffects(const jktools::ColourEffects& table, unsigned)
        : cog(column<std::int32_t>(table.cog(), table.cog_packed(), 1, 0)),
          script(column<std::uint32_t>(table.script(), table.script_packed(), 1, cog.rows())),
          line(column<std::int32_t>(table.line(), table.line_packed(), 1, cog.rows())),
          argument(column<double>(table.argument(), table.argument_packed(), 10, cog.rows())),
          colormap(column<std::int32_t>(table.colormap(), table.colormap_packed(), 1, cog.rows(), -1)),
          palette(column<std::uint8_t>(table.palette(), table.palette_packed(), 768, cog.rows())) {}
};

struct Motion {
    Column<std::int32_t> template_;
    Column<double> walk;
    Column<double> back;
    Column<double> strafe;
    Column<double> run;
    Column<double> crouch;
    Column<double> air;
    Column<double> swim;
    Column<double> stop_walk;
    Column<double> stop_run;
    Column<double> jump_height;
    Column<double> crouched_jump_height;
    Column<double> jump_reach;
    Column<double> run_jump_reach;

    Motion() = default;
    Motion(const jktools::Motion& table, unsigned)
        : template_(column<std::int32_t>(table.template_(), table.template_packed(), 1, 0)),
          walk(column<double>(table.walk(), table.walk_packed(), 1, template_.rows())),
          back(column<double>(table.back(), table.back_packed(), 1, template_.rows())),
          strafe(column<double>(table.strafe(), table.strafe_packed(), 1, template_.rows())),
          run(column<double>(table.run(), table.run_packed(), 1, template_.rows())),
          crouch(column<double>(table.crouch(), table.crouch_packed(), 1, template_.rows())),
          air(column<double>(table.air(), table.air_packed(), 1, template_.rows())),
          swim(column<double>(table.swim(), table.swim_packed(), 1, template_.rows())),
          stop_walk(column<double>(table.stop_walk(), table.stop_walk_packed(), 2, template_.rows())),
          stop_run(column<double>(table.stop_run(), table.stop_run_packed(), 2, template_.rows())),
          jump_height(column<double>(table.jump_height(), table.jump_height_packed(), 1, template_.rows())),
          crouched_jump_height(column<double>(table.crouched_jump_height(), table.crouched_jump_height_packed(), 1, template_.rows())),
          jump_reach(column<double>(table.jump_reach(), table.jump_reach_packed(), 1, template_.rows())),
          run_jump_reach(column<double>(table.run_jump_reach(), table.run_jump_reach_packed(), 1, template_.rows())) {}
};

struct Ledges {
    Column<float> body_movesize;
    Column<std::uint32_t> body_name;
    Column<std::int32_t> surface;
    Column<float> body_hover;
    Column<float> body_reattach;
    Column<float> body_step;
    Column<float> body_jump;
    Column<std::uint32_t> body_physics_flags;
    Column<std::uint8_t> body_player;
    Column<std::uint32_t> body_name_start;
    Column<std::uint32_t> body_ledge_start;
    Column<std::uint8_t> corner;
    Column<float> start;
    Column<float> end;
    Column<std::uint8_t> kind;
    Column<std::uint8_t> other_kind;
    Column<std::int32_t> below;
    Column<std::int32_t> thing;
    Column<float> drop_start;
    Column<float> drop_end;
    Column<std::uint8_t> traits;
    Column<std::int32_t> carrier;
    Column<std::int32_t> carrier_frame;
    Column<std::int32_t> carrier_face;
    Column<std::int32_t> onto;
    Column<std::int32_t> onto_face;

    Ledges() = default;
    Ledges(const jktools::Ledges& table, unsigned minor)
        : body_movesize(column<float>(table.body_movesize(), table.body_movesize_packed(), 1, 0)),
          body_name(column<std::uint32_t>(table.body_name(), table.body_name_packed(), 1, 0)),
          surface(column<std::int32_t>(table.surface(), table.surface_packed(), 1, 0, -1)),
          body_hover(column<float>(table.body_hover(), table.body_hover_packed(), 1, body_movesize.rows())),
          body_reattach(column<float>(table.body_reattach(), table.body_reattach_packed(), 1, body_movesize.rows())),
          body_step(column<float>(table.body_step(), table.body_step_packed(), 1, body_movesize.rows())),
          body_jump(column<float>(table.body_jump(), table.body_jump_packed(), 1, body_movesize.rows())),
          body_physics_flags(column<std::uint32_t>(table.body_physics_flags(), table.body_physics_flags_packed(), 1, body_movesize.rows())),
          body_player(column<std::uint8_t>(table.body_player(), table.body_player_packed(), 1, body_movesize.rows())),
          body_name_start(column<std::uint32_t>(table.body_name_start(), table.body_name_start_packed(), 1, body_movesize.rows())),
          body_ledge_start(column<std::uint32_t>(table.body_ledge_start(), table.body_ledge_start_packed(), 1, body_movesize.rows())),
          corner(column<std::uint8_t>(table.corner(), table.corner_packed(), 1, surface.rows())),
          start(column<float>(table.start(), table.start_packed(), 1, surface.rows())),
          end(column<float>(table.end(), table.end_packed(), 1, surface.rows())),
          kind(column<std::uint8_t>(table.kind(), table.kind_packed(), 1, surface.rows())),
          other_kind(column<std::uint8_t>(table.other_kind(), table.other_kind_packed(), 1, surface.rows())),
          below(column<std::int32_t>(table.below(), table.below_packed(), 1, surface.rows(), -1)),
          thing(column<std::int32_t>(table.thing(), table.thing_packed(), 1, surface.rows())),
          drop_start(column<float>(table.drop_start(), table.drop_start_packed(), 1, surface.rows())),
          drop_end(column<float>(table.drop_end(), table.drop_end_packed(), 1, surface.rows())),
          traits(column<std::uint8_t>(table.traits(), table.traits_packed(), 1, surface.rows())),
          carrier(minor >= 2 ? column<std::int32_t>(table.carrier(), table.carrier_packed(), 1, surface.rows(), -1) : Column<std::int32_t>()),
          carrier_frame(minor >= 2 ? column<std::int32_t>(table.carrier_frame(), table.carrier_frame_packed(), 1, surface.rows(), -1) : Column<std::int32_t>()),
          carrier_face(minor >= 2 ? column<std::int32_t>(table.carrier_face(), table.carrier_face_packed(), 1, surface.rows(), -1) : Column<std::int32_t>()),
          onto(minor >= 2 ? column<std::int32_t>(table.onto(), table.onto_packed(), 1, surface.rows(), -1) : Column<std::int32_t>()),
          onto_face(minor >= 2 ? column<std::int32_t>(table.onto_face(), table.onto_face_packed(), 1, surface.rows(), -1) : Column<std::int32_t>()) {}
};

struct Basins {
    Column<std::int32_t> body;
    Column<std::int32_t> surface;
    Column<std::uint32_t> surface_start;
    Column<float> shallowest;
    Column<float> deepest;
    Column<std::uint8_t> entered;
    Column<std::uint8_t> left;

    Basins() = default;
    Basins(const jktools::Basins& table, unsigned)
        : body(column<std::int32_t>(table.body(), table.body_packed(), 1, 0)),
          surface(column<std::int32_t>(table.surface(), table.surface_packed(), 1, 0)),
          surface_start(column<std::uint32_t>(table.surface_start(), table.surface_start_packed(), 1, body.rows())),
          shallowest(column<float>(table.shallowest(), table.shallowest_packed(), 1, body.rows())),
          deepest(column<float>(table.deepest(), table.deepest_packed(), 1, body.rows())),
          entered(column<std::uint8_t>(table.entered(), table.entered_packed(), 1, body.rows())),
          left(column<std::uint8_t>(table.left(), table.left_packed(), 1, body.rows())) {}
};

struct Models {
    Column<std::uint32_t> name;
    Column<float> insert_offset;
    Column<float> radius;
    Column<std::uint8_t> known;

    Models() = default;
    Models(const jktools::Models& table, unsigned minor)
        : name(minor >= 3 ? column<std::uint32_t>(table.name(), table.name_packed(), 1, 0) : Column<std::uint32_t>()),
          insert_offset(minor >= 3 ? column<float>(table.insert_offset(), table.insert_offset_packed(), 3, name.rows()) : Column<float>()),
          radius(minor >= 3 ? column<float>(table.radius(), table.radius_packed(), 1, name.rows()) : Column<float>()),
          known(minor >= 3 ? column<std::uint8_t>(table.known(), table.known_packed(), 1, name.rows()) : Column<std::uint8_t>()) {}
};

struct Files {
    Column<std::uint32_t> name;
    Column<std::uint8_t> sha256;
    Column<std::uint32_t> folder;
    Column<std::uint8_t> found;

    Files() = default;
    Files(const jktools::Files& table, unsigned minor)
        : name(minor >= 3 ? column<std::uint32_t>(table.name(), table.name_packed(), 1, 0) : Column<std::uint32_t>()),
          sha256(minor >= 3 ? column<std::uint8_t>(table.sha256(), table.sha256_packed(), 32, 0) : Column<std::uint8_t>()),
          folder(minor >= 3 ? column<std::uint32_t>(table.folder(), table.folder_packed(), 1, name.rows()) : Column<std::uint32_t>()),
          found(minor >= 3 ? column<std::uint8_t>(table.found(), table.found_packed(), 1, name.rows()) : Column<std::uint8_t>()) {}
};

// Absent is what the level did not need; resources and geometry never are.
struct Sections {
    std::optional<Resources> resources;
    std::optional<Geometry> geometry;
    std::optional<Templates> templates;
    std::optional<Things> things;
    std::optional<Cogs> cogs;
    std::optional<Visibility> visibility;
    std::optional<Hotspots> hotspots;
    std::optional<Lights> lights;
    std::optional<Particles> particles;
    std::optional<ColourEffects> colour_effects;
    std::optional<Motion> motion;
    std::optional<Ledges> ledges;
    std::optional<Basins> basins;
    std::optional<Models> models;
    std::optional<Files> files;

    Sections() = default;
    explicit Sections(const jktools::Level& level) {
        const unsigned minor = level.format_minor();
        if (const auto* table = level.resources()) resources.emplace(*table, minor);
        if (const auto* table = level.geometry()) geometry.emplace(*table, minor);
        if (const auto* table = level.templates()) templates.emplace(*table, minor);
        if (const auto* table = level.things()) things.emplace(*table, minor);
        if (const auto* table = level.cogs()) cogs.emplace(*table, minor);
        if (const auto* table = level.visibility()) visibility.emplace(*table, minor);
        if (const auto* table = level.hotspots()) hotspots.emplace(*table, minor);
        if (const auto* table = level.lights()) lights.emplace(*table, minor);
        if (const auto* table = level.particles()) particles.emplace(*table, minor);
        if (const auto* table = level.colour_effects()) colour_effects.emplace(*table, minor);
        if (const auto* table = level.motion()) motion.emplace(*table, minor);
        if (const auto* table = level.ledges()) ledges.emplace(*table, minor);
        if (const auto* table = level.basins()) basins.emplace(*table, minor);
        if (const auto* table = level.models()) models.emplace(*table, minor);
        if (const auto* table = level.files()) files.emplace(*table, minor);
    }
};

inline void check_level(Checks& check, const Text& own, unsigned minor) {
    check.form("level.text", own.text);
    check.form("level.text_start", own.text_start);
    check.cuts("level.text_start", own.text_start, own.text.rows());
    if (minor >= 3) check.form("level.symbols", own.symbols);
}

inline void check_omission(Checks& check, const Omission& own, std::size_t strings) {
    check.form("omission.source", own.source);
    check.form("omission.name_text", own.name_text);
    check.rows("omission.name_text", own.name_text, own.source.rows());
    check.indices("omission.name_text", own.name_text, 0, strings, "strings");
}

inline void check_resources(Checks& check, const Resources& own, std::size_t strings) {
    check.form("resources.sounds", own.sounds);
    check.indices("resources.sounds", own.sounds, 0, strings, "strings");
    check.form("resources.materials", own.materials);
    check.indices("resources.materials", own.materials, 0, strings, "strings");
    check.form("resources.colormaps", own.colormaps);
    check.indices("resources.colormaps", own.colormaps, 0, strings, "strings");
    check.form("resources.aiclasses", own.aiclasses);
    check.indices("resources.aiclasses", own.aiclasses, 0, strings, "strings");
    check.form("resources.models", own.models);
    check.indices("resources.models", own.models, 0, strings, "strings");
    check.form("resources.sprites", own.sprites);
    check.indices("resources.sprites", own.sprites, 0, strings, "strings");
    check.form("resources.keyframes", own.keyframes);
    check.indices("resources.keyframes", own.keyframes, 0, strings, "strings");
    check.form("resources.animclasses", own.animclasses);
    check.indices("resources.animclasses", own.animclasses, 0, strings, "strings");
    check.form("resources.soundclasses", own.soundclasses);
    check.indices("resources.soundclasses", own.soundclasses, 0, strings, "strings");
    check.form("resources.cogscripts", own.cogscripts);
    check.indices("resources.cogscripts", own.cogscripts, 0, strings, "strings");
}

inline void check_geometry(Checks& check, const Geometry& own, const Sections& all, std::size_t strings) {
    check.form("geometry.vertices", own.vertices);
    check.form("geometry.texture_vertices", own.texture_vertices);
    check.form("geometry.adjoin_flags", own.adjoin_flags);
    check.form("geometry.adjoin_mirror", own.adjoin_mirror);
    check.rows("geometry.adjoin_mirror", own.adjoin_mirror, own.adjoin_flags.rows());
    check.indices("geometry.adjoin_mirror", own.adjoin_mirror, 0, own.adjoin_flags.rows(), "adjoin_flags");
    check.form("geometry.adjoin_distance", own.adjoin_distance);
    check.rows("geometry.adjoin_distance", own.adjoin_distance, own.adjoin_flags.rows());
    check.form("geometry.adjoin_surface", own.adjoin_surface);
    check.rows("geometry.adjoin_surface", own.adjoin_surface, own.adjoin_flags.rows());
    check.indices("geometry.adjoin_surface", own.adjoin_surface, -1, own.surface_flags.rows(), "surface_flags");
    check.form("geometry.surface_material", own.surface_material);
    check.rows("geometry.surface_material", own.surface_material, own.surface_flags.rows());
    check.indices("geometry.surface_material", own.surface_material, -1, (all.resources ? all.resources->materials.rows() : 0), "resources.materials");
    check.form("geometry.surface_flags", own.surface_flags);
    check.form("geometry.surface_face_flags", own.surface_face_flags);
    check.rows("geometry.surface_face_flags", own.surface_face_flags, own.surface_flags.rows());
    check.form("geometry.surface_geometry_mode", own.surface_geometry_mode);
    check.rows("geometry.surface_geometry_mode", own.surface_geometry_mode, own.surface_flags.rows());
    check.form("geometry.surface_light_mode", own.surface_light_mode);
    check.rows("geometry.surface_light_mode", own.surface_light_mode, own.surface_flags.rows());
    check.form("geometry.surface_texture_mode", own.surface_texture_mode);
    check.rows("geometry.surface_texture_mode", own.surface_texture_mode, own.surface_flags.rows());
    check.form("geometry.surface_adjoin", own.surface_adjoin);
    check.rows("geometry.surface_adjoin", own.surface_adjoin, own.surface_flags.rows());
    check.indices("geometry.surface_adjoin", own.surface_adjoin, -1, own.adjoin_flags.rows(), "adjoin_flags");
    check.form("geometry.surface_extra_light", own.surface_extra_light);
    check.rows("geometry.surface_extra_light", own.surface_extra_light, own.surface_flags.rows());
    check.form("geometry.surface_normal", own.surface_normal);
    check.rows("geometry.surface_normal", own.surface_normal, own.surface_flags.rows());
    check.form("geometry.surface_sector", own.surface_sector);
    check.rows("geometry.surface_sector", own.surface_sector, own.surface_flags.rows());
    check.indices("geometry.surface_sector", own.surface_sector, -1, own.sector_flags.rows(), "sector_flags");
    check.form("geometry.surface_corner_start", own.surface_corner_start);
    check.cuts("geometry.surface_corner_start", own.surface_corner_start, own.corner_vertex.rows());
    check.rows("geometry.surface_corner_start", own.surface_corner_start, own.surface_flags.rows() + 1);
    check.form("geometry.corner_vertex", own.corner_vertex);
    check.indices("geometry.corner_vertex", own.corner_vertex, 0, own.vertices.rows(), "vertices");
    check.form("geometry.corner_texture_vertex", own.corner_texture_vertex);
    check.rows("geometry.corner_texture_vertex", own.corner_texture_vertex, own.corner_vertex.rows());
    check.indices("geometry.corner_texture_vertex", own.corner_texture_vertex, -1, own.texture_vertices.rows(), "texture_vertices");
    check.form("geometry.surface_light_start", own.surface_light_start);
    check.cuts("geometry.surface_light_start", own.surface_light_start, own.corner_light.rows());
    check.rows("geometry.surface_light_start", own.surface_light_start, own.surface_flags.rows() + 1);
    check.form("geometry.corner_light", own.corner_light);
    check.form("geometry.sector_flags", own.sector_flags);
    check.form("geometry.sector_ambient_light", own.sector_ambient_light);
    check.rows("geometry.sector_ambient_light", own.sector_ambient_light, own.sector_flags.rows());
    check.form("geometry.sector_extra_light", own.sector_extra_light);
    check.rows("geometry.sector_extra_light", own.sector_extra_light, own.sector_flags.rows());
    check.form("geometry.sector_colormap", own.sector_colormap);
    check.rows("geometry.sector_colormap", own.sector_colormap, own.sector_flags.rows());
    check.form("geometry.sector_tint", own.sector_tint);
    check.rows("geometry.sector_tint", own.sector_tint, own.sector_flags.rows());
    check.form("geometry.sector_bound_box", own.sector_bound_box);
    check.rows("geometry.sector_bound_box", own.sector_bound_box, own.sector_flags.rows());
    check.form("geometry.sector_collide_box", own.sector_collide_box);
    check.rows("geometry.sector_collide_box", own.sector_collide_box, own.sector_flags.rows());
    check.form("geometry.sector_sound", own.sector_sound);
    check.rows("geometry.sector_sound", own.sector_sound, own.sector_flags.rows());
    check.indices("geometry.sector_sound", own.sector_sound, -1, strings, "strings");
    check.form("geometry.sector_sound_volume", own.sector_sound_volume);
    check.rows("geometry.sector_sound_volume", own.sector_sound_volume, own.sector_flags.rows());
    check.form("geometry.sector_center", own.sector_center);
    check.rows("geometry.sector_center", own.sector_center, own.sector_flags.rows());
    check.form("geometry.sector_radius", own.sector_radius);
    check.rows("geometry.sector_radius", own.sector_radius, own.sector_flags.rows());
    check.form("geometry.sector_vertex_start", own.sector_vertex_start);
    check.cuts("geometry.sector_vertex_start", own.sector_vertex_start, own.sector_vertex.rows());
    check.rows("geometry.sector_vertex_start", own.sector_vertex_start, own.sector_flags.rows() + 1);
    check.form("geometry.sector_vertex", own.sector_vertex);
    check.indices("geometry.sector_vertex", own.sector_vertex, 0, own.vertices.rows(), "vertices");
    check.form("geometry.sector_first_surface", own.sector_first_surface);
    check.rows("geometry.sector_first_surface", own.sector_first_surface, own.sector_flags.rows());
    check.form("geometry.sector_surface_count", own.sector_surface_count);
    check.rows("geometry.sector_surface_count", own.sector_surface_count, own.sector_flags.rows());
}

inline void check_templates(Checks& check, const Templates& own, std::size_t strings, unsigned minor) {
    check.form("templates.source", own.source);
    check.form("templates.name", own.name);
    check.rows("templates.name", own.name, own.source.rows());
    check.indices("templates.name", own.name, 0, strings, "strings");
    check.form("templates.parent", own.parent);
    check.rows("templates.parent", own.parent, own.source.rows());
    check.indices("templates.parent", own.parent, 0, strings, "strings");
    if (minor <= 1) {
        check.form("templates.parameter_start", own.parameter_start);
        check.cuts("templates.parameter_start", own.parameter_start, own.parameter_key.rows());
        check.rows("templates.parameter_start", own.parameter_start, own.source.rows() + 1);
    }
    if (minor <= 1) {
        check.form("templates.parameter_key", own.parameter_key);
        check.indices("templates.parameter_key", own.parameter_key, 0, strings, "strings");
    }
    if (minor <= 1) {
        check.form("templates.parameter_value", own.parameter_value);
        check.rows("templates.parameter_value", own.parameter_value, own.parameter_key.rows());
        check.indices("templates.parameter_value", own.parameter_value, 0, strings, "strings");
    }
    if (minor >= 1) {
        check.form("templates.type", own.type);
        check.rows("templates.type", own.type, own.source.rows());
    }
    if (minor >= 1) {
        check.form("templates.move", own.move);
        check.rows("templates.move", own.move, own.source.rows());
    }
    if (minor >= 1) {
        check.form("templates.has_ai", own.has_ai);
        check.rows("templates.has_ai", own.has_ai, own.source.rows());
    }
    if (minor >= 1 && minor <= 2) {
        check.form("templates.value_start", own.value_start);
        check.cuts("templates.value_start", own.value_start, own.value_key.rows());
        check.rows("templates.value_start", own.value_start, own.source.rows() + 1);
    }
    if (minor >= 1 && minor <= 2) {
        check.form("templates.value_key", own.value_key);
        check.indices("templates.value_key", own.value_key, 0, strings, "strings");
    }
    if (minor >= 1 && minor <= 2) {
        check.form("templates.value_text", own.value_text);
        check.rows("templates.value_text", own.value_text, own.value_key.rows());
        check.indices("templates.value_text", own.value_text, -1, strings, "strings");
    }
    if (minor >= 1 && minor <= 2) {
        check.form("templates.value_source", own.value_source);
        check.rows("templates.value_source", own.value_source, own.value_key.rows());
    }
    if (minor >= 1 && minor <= 1) {
        check.form("templates.number_start", own.number_start);
        check.cuts("templates.number_start", own.number_start, own.number.rows());
        check.rows("templates.number_start", own.number_start, own.value_key.rows() + 1);
    }
    if (minor >= 1 && minor <= 1) check.form("templates.number", own.number);
    if (minor >= 2 && minor <= 2) {
        check.form("templates.value_list", own.value_list);
        check.rows("templates.value_list", own.value_list, own.value_key.rows());
        check.indices("templates.value_list", own.value_list, 0, std::max<std::size_t>(own.list_start.rows(), 1) - 1, "list_start");
    }
    if (minor >= 2) {
        check.form("templates.list_start", own.list_start);
        check.cuts("templates.list_start", own.list_start, own.list_number.rows());
    }
    if (minor >= 2) check.form("templates.list_number", own.list_number);
    if (minor >= 2) {
        check.form("templates.unused_start", own.unused_start);
        check.cuts("templates.unused_start", own.unused_start, own.unused_key.rows());
        check.rows("templates.unused_start", own.unused_start, own.source.rows() + 1);
    }
    if (minor >= 2) {
        check.form("templates.unused_key", own.unused_key);
        check.indices("templates.unused_key", own.unused_key, 0, strings, "strings");
    }
    if (minor >= 2) {
        check.form("templates.unused_value", own.unused_value);
        check.rows("templates.unused_value", own.unused_value, own.unused_key.rows());
        check.indices("templates.unused_value", own.unused_value, 0, strings, "strings");
    }
    if (minor >= 3) {
        check.form("templates.base", own.base);
        check.rows("templates.base", own.base, own.source.rows());
        check.indices("templates.base", own.base, -1, own.source.rows(), "source");
    }
    if (minor >= 3) {
        check.form("templates.own_start", own.own_start);
        check.cuts("templates.own_start", own.own_start, own.own_key.rows());
        check.rows("templates.own_start", own.own_start, own.source.rows() + 1);
    }
    if (minor >= 3) {
        check.form("templates.own_key", own.own_key);
        check.indices("templates.own_key", own.own_key, 0, strings, "strings");
    }
    if (minor >= 3) {
        check.form("templates.own_text", own.own_text);
        check.rows("templates.own_text", own.own_text, own.own_key.rows());
        check.indices("templates.own_text", own.own_text, -1, strings, "strings");
    }
    if (minor >= 3) {
        check.form("templates.own_setter", own.own_setter);
        check.rows("templates.own_setter", own.own_setter, own.own_key.rows());
    }
    if (minor >= 3) {
        check.form("templates.own_list", own.own_list);
        check.rows("templates.own_list", own.own_list, own.own_key.rows());
        check.indices("templates.own_list", own.own_list, 0, std::max<std::size_t>(own.list_start.rows(), 1) - 1, "list_start");
    }
}

inline void check_things(Checks& check, const Things& own, const Sections& all, std::size_t strings) {
    check.form("things.source", own.source);
    check.form("things.number", own.number);
    check.rows("things.number", own.number, own.source.rows());
    check.form("things.template", own.template_);
    check.rows("things.template", own.template_, own.source.rows());
    check.indices("things.template", own.template_, 0, strings, "strings");
    check.form("things.name", own.name);
    check.rows("things.name", own.name, own.source.rows());
    check.indices("things.name", own.name, 0, strings, "strings");
    check.form("things.position", own.position);
    check.rows("things.position", own.position, own.source.rows());
    check.form("things.angles", own.angles);
    check.rows("things.angles", own.angles, own.source.rows());
    check.form("things.sector", own.sector);
    check.rows("things.sector", own.sector, own.source.rows());
    check.indices("things.sector", own.sector, 0, (all.geometry ? all.geometry->sector_flags.rows() : 0), "geometry.sector_flags");
    check.form("things.arch_light", own.arch_light);
    check.rows("things.arch_light", own.arch_light, own.source.rows());
    check.form("things.parameter_start", own.parameter_start);
    check.cuts("things.parameter_start", own.parameter_start, own.parameter_key.rows());
    check.rows("things.parameter_start", own.parameter_start, own.source.rows() + 1);
    check.form("things.parameter_key", own.parameter_key);
    check.indices("things.parameter_key", own.parameter_key, 0, strings, "strings");
    check.form("things.parameter_value", own.parameter_value);
    check.rows("things.parameter_value", own.parameter_value, own.parameter_key.rows());
    check.indices("things.parameter_value", own.parameter_value, 0, strings, "strings");
}

inline void check_cogs(Checks& check, const Cogs& own, std::size_t strings) {
    check.form("cogs.source", own.source);
    check.form("cogs.script", own.script);
    check.rows("cogs.script", own.script, own.source.rows());
    check.indices("cogs.script", own.script, 0, strings, "strings");
    check.form("cogs.value_start", own.value_start);
    check.cuts("cogs.value_start", own.value_start, own.value.rows());
    check.rows("cogs.value_start", own.value_start, own.source.rows() + 1);
    check.form("cogs.value", own.value);
    check.indices("cogs.value", own.value, 0, strings, "strings");
}

inline void check_visibility(Checks& check, const Visibility& own, const Sections& all) {
    check.form("visibility.sector", own.sector);
    check.indices("visibility.sector", own.sector, 0, (all.geometry ? all.geometry->sector_flags.rows() : 0), "geometry.sector_flags");
    check.form("visibility.row_start", own.row_start);
    check.cuts("visibility.row_start", own.row_start, own.row.rows());
    check.rows("visibility.row_start", own.row_start, own.sector.rows() + 1);
    check.form("visibility.row", own.row);
}

inline void check_hotspots(Checks& check, const Hotspots& own, std::size_t strings) {
    check.form("hotspots.cog", own.cog);
    check.form("hotspots.script", own.script);
    check.rows("hotspots.script", own.script, own.cog.rows());
    check.indices("hotspots.script", own.script, 0, strings, "strings");
    check.form("hotspots.verb", own.verb);
    check.rows("hotspots.verb", own.verb, own.cog.rows());
    check.indices("hotspots.verb", own.verb, 0, strings, "strings");
    check.form("hotspots.line", own.line);
    check.rows("hotspots.line", own.line, own.cog.rows());
    check.form("hotspots.things", own.things);
    check.rows("hotspots.things", own.things, own.cog.rows());
    check.form("hotspots.more", own.more);
    check.rows("hotspots.more", own.more, own.cog.rows());
    check.form("hotspots.calls_per_second", own.calls_per_second);
    check.rows("hotspots.calls_per_second", own.calls_per_second, own.cog.rows());
    check.form("hotspots.mean_sectors", own.mean_sectors);
    check.rows("hotspots.mean_sectors", own.mean_sectors, own.cog.rows());
    check.form("hotspots.mean_surfaces", own.mean_surfaces);
    check.rows("hotspots.mean_surfaces", own.mean_surfaces, own.cog.rows());
    check.form("hotspots.most_sectors", own.most_sectors);
    check.rows("hotspots.most_sectors", own.most_sectors, own.cog.rows());
    check.form("hotspots.most_surfaces", own.most_surfaces);
    check.rows("hotspots.most_surfaces", own.most_surfaces, own.cog.rows());
    check.form("hotspots.pairs", own.pairs);
    check.rows("hotspots.pairs", own.pairs, own.cog.rows());
    check.form("hotspots.verdict", own.verdict);
    check.rows("hotspots.verdict", own.verdict, own.cog.rows());
}

inline void check_lights(Checks& check, const Lights& own, const Sections& all) {
    check.form("lights.thing", own.thing);
    check.form("lights.position", own.position);
    check.rows("lights.position", own.position, own.thing.rows());
    check.form("lights.intensity", own.intensity);
    check.rows("lights.intensity", own.intensity, own.thing.rows());
    check.form("lights.reach", own.reach);
    check.rows("lights.reach", own.reach, own.thing.rows());
    check.form("lights.vertex_start", own.vertex_start);
    check.cuts("lights.vertex_start", own.vertex_start, own.vertex.rows());
    check.rows("lights.vertex_start", own.vertex_start, own.thing.rows() + 1);
    check.form("lights.vertex", own.vertex);
    check.indices("lights.vertex", own.vertex, 0, (all.geometry ? all.geometry->vertices.rows() : 0), "geometry.vertices");
    check.form("lights.amount", own.amount);
    check.rows("lights.amount", own.amount, own.vertex.rows());
}

inline void check_particles(Checks& check, const Particles& own, std::size_t strings) {
    check.form("particles.template", own.template_);
    check.form("particles.material", own.material);
    check.rows("particles.material", own.material, own.template_.rows());
    check.indices("particles.material", own.material, -1, strings, "strings");
    check.form("particles.cels", own.cels);
    check.rows("particles.cels", own.cels, own.template_.rows());
    check.form("particles.spawned", own.spawned);
    check.rows("particles.spawned", own.spawned, own.template_.rows());
    check.form("particles.timer_ms", own.timer_ms);
    check.rows("particles.timer_ms", own.timer_ms, own.template_.rows());
    check.form("particles.flags", own.flags);
    check.rows("particles.flags", own.flags, own.template_.rows());
    check.form("particles.range", own.range);
    check.rows("particles.range", own.range, own.template_.rows());
    check.form("particles.minsize", own.minsize);
    check.rows("particles.minsize", own.minsize, own.template_.rows());
    check.form("particles.lost_a_step", own.lost_a_step);
    check.rows("particles.lost_a_step", own.lost_a_step, own.template_.rows());
    check.form("particles.maxthrust", own.maxthrust);
    check.rows("particles.maxthrust", own.maxthrust, own.template_.rows());
    check.form("particles.elementsize", own.elementsize);
    check.rows("particles.elementsize", own.elementsize, own.template_.rows());
    check.form("particles.pitchrange", own.pitchrange);
    check.rows("particles.pitchrange", own.pitchrange, own.template_.rows());
    check.form("particles.yawrange", own.yawrange);
    check.rows("particles.yawrange", own.yawrange, own.template_.rows());
    check.form("particles.light_mode", own.light_mode);
    check.rows("particles.light_mode", own.light_mode, own.template_.rows());
}

inline void check_colour_effects(Checks& check, const ColourEffects& own, const Sections& all, std::size_t strings) {
    check.form("colour_effects.cog", own.cog);
    check.form("colour_effects.script", own.script);
    check.rows("colour_effects.script", own.script, own.cog.rows());
    check.indices("colour_effects.script", own.script, 0, strings, "strings");
    check.form("colour_effects.line", own.line);
    check.rows("colour_effects.line", own.line, own.cog.rows());
    check.form("colour_effects.argument", own.argument);
    check.rows("colour_effects.argument", own.argument, own.cog.rows());
    check.form("colour_effects.colormap", own.colormap);
    check.rows("colour_effects.colormap", own.colormap, own.cog.rows());
    check.indices("colour_effects.colormap", own.colormap, -1, (all.resources ? all.resources->colormaps.rows() : 0), "resources.colormaps");
    check.form("colour_effects.palette", own.palette);
    check.rows("colour_effects.palette", own.palette, own.cog.rows());
}

inline void check_motion(Checks& check, const Motion& own) {
    check.form("motion.template", own.template_);
    check.form("motion.walk", own.walk);
    check.rows("motion.walk", own.walk, own.template_.rows());
    check.form("motion.back", own.back);
    check.rows("motion.back", own.back, own.template_.rows());
    check.form("motion.strafe", own.strafe);
    check.rows("motion.strafe", own.strafe, own.template_.rows());
    check.form("motion.run", own.run);
    check.rows("motion.run", own.run, own.template_.rows());
    check.form("motion.crouch", own.crouch);
    check.rows("motion.crouch", own.crouch, own.template_.rows());
    check.form("motion.air", own.air);
    check.rows("motion.air", own.air, own.template_.rows());
    check.form("motion.swim", own.swim);
    check.rows("motion.swim", own.swim, own.template_.rows());
    check.form("motion.stop_walk", own.stop_walk);
    check.rows("motion.stop_walk", own.stop_walk, own.template_.rows());
    check.form("motion.stop_run", own.stop_run);
    check.rows("motion.stop_run", own.stop_run, own.template_.rows());
    check.form("motion.jump_height", own.jump_height);
    check.rows("motion.jump_height", own.jump_height, own.template_.rows());
    check.form("motion.crouched_jump_height", own.crouched_jump_height);
    check.rows("motion.crouched_jump_height", own.crouched_jump_height, own.template_.rows());
    check.form("motion.jump_reach", own.jump_reach);
    check.rows("motion.jump_reach", own.jump_reach, own.template_.rows());
    check.form("motion.run_jump_reach", own.run_jump_reach);
    check.rows("motion.run_jump_reach", own.run_jump_reach, own.template_.rows());
}

inline void check_ledges(Checks& check, const Ledges& own, const Sections& all, std::size_t strings, unsigned minor) {
    check.form("ledges.body_movesize", own.body_movesize);
    check.form("ledges.body_hover", own.body_hover);
    check.rows("ledges.body_hover", own.body_hover, own.body_movesize.rows());
    check.form("ledges.body_reattach", own.body_reattach);
    check.rows("ledges.body_reattach", own.body_reattach, own.body_movesize.rows());
    check.form("ledges.body_step", own.body_step);
    check.rows("ledges.body_step", own.body_step, own.body_movesize.rows());
    check.form("ledges.body_jump", own.body_jump);
    check.rows("ledges.body_jump", own.body_jump, own.body_movesize.rows());
    check.form("ledges.body_physics_flags", own.body_physics_flags);
    check.rows("ledges.body_physics_flags", own.body_physics_flags, own.body_movesize.rows());
    check.form("ledges.body_player", own.body_player);
    check.rows("ledges.body_player", own.body_player, own.body_movesize.rows());
    check.form("ledges.body_name_start", own.body_name_start);
    check.cuts("ledges.body_name_start", own.body_name_start, own.body_name.rows());
    check.rows("ledges.body_name_start", own.body_name_start, own.body_movesize.rows() + 1);
    check.form("ledges.body_name", own.body_name);
    check.indices("ledges.body_name", own.body_name, 0, strings, "strings");
    check.form("ledges.body_ledge_start", own.body_ledge_start);
    check.cuts("ledges.body_ledge_start", own.body_ledge_start, own.surface.rows());
    check.rows("ledges.body_ledge_start", own.body_ledge_start, own.body_movesize.rows() + 1);
    check.form("ledges.surface", own.surface);
    check.indices("ledges.surface", own.surface, -1, (all.geometry ? all.geometry->surface_flags.rows() : 0), "geometry.surface_flags");
    check.form("ledges.corner", own.corner);
    check.rows("ledges.corner", own.corner, own.surface.rows());
    check.form("ledges.start", own.start);
    check.rows("ledges.start", own.start, own.surface.rows());
    check.form("ledges.end", own.end);
    check.rows("ledges.end", own.end, own.surface.rows());
    check.form("ledges.kind", own.kind);
    check.rows("ledges.kind", own.kind, own.surface.rows());
    check.form("ledges.other_kind", own.other_kind);
    check.rows("ledges.other_kind", own.other_kind, own.surface.rows());
    check.form("ledges.below", own.below);
    check.rows("ledges.below", own.below, own.surface.rows());
    check.indices("ledges.below", own.below, -1, (all.geometry ? all.geometry->surface_flags.rows() : 0), "geometry.surface_flags");
    check.form("ledges.thing", own.thing);
    check.rows("ledges.thing", own.thing, own.surface.rows());
    check.form("ledges.drop_start", own.drop_start);
    check.rows("ledges.drop_start", own.drop_start, own.surface.rows());
    check.form("ledges.drop_end", own.drop_end);
    check.rows("ledges.drop_end", own.drop_end, own.surface.rows());
    check.form("ledges.traits", own.traits);
    check.rows("ledges.traits", own.traits, own.surface.rows());
    if (minor >= 2) {
        check.form("ledges.carrier", own.carrier);
        check.rows("ledges.carrier", own.carrier, own.surface.rows());
    }
    if (minor >= 2) {
        check.form("ledges.carrier_frame", own.carrier_frame);
        check.rows("ledges.carrier_frame", own.carrier_frame, own.surface.rows());
    }
    if (minor >= 2) {
        check.form("ledges.carrier_face", own.carrier_face);
        check.rows("ledges.carrier_face", own.carrier_face, own.surface.rows());
    }
    if (minor >= 2) {
        check.form("ledges.onto", own.onto);
        check.rows("ledges.onto", own.onto, own.surface.rows());
    }
    if (minor >= 2) {
        check.form("ledges.onto_face", own.onto_face);
        check.rows("ledges.onto_face", own.onto_face, own.surface.rows());
    }
}

inline void check_basins(Checks& check, const Basins& own, const Sections& all) {
    check.form("basins.body", own.body);
    check.indices("basins.body", own.body, 0, (all.ledges ? all.ledges->body_movesize.rows() : 0), "ledges.body_movesize");
    check.form("basins.surface_start", own.surface_start);
    check.cuts("basins.surface_start", own.surface_start, own.surface.rows());
    check.rows("basins.surface_start", own.surface_start, own.body.rows() + 1);
    check.form("basins.surface", own.surface);
    check.indices("basins.surface", own.surface, 0, (all.geometry ? all.geometry->surface_flags.rows() : 0), "geometry.surface_flags");
    check.form("basins.shallowest", own.shallowest);
    check.rows("basins.shallowest", own.shallowest, own.body.rows());
    check.form("basins.deepest", own.deepest);
    check.rows("basins.deepest", own.deepest, own.body.rows());
    check.form("basins.entered", own.entered);
    check.rows("basins.entered", own.entered, own.body.rows());
    check.form("basins.left", own.left);
    check.rows("basins.left", own.left, own.body.rows());
}

inline void check_models(Checks& check, const Models& own, std::size_t strings, unsigned minor) {
    if (minor >= 3) {
        check.form("models.name", own.name);
        check.indices("models.name", own.name, 0, strings, "strings");
    }
    if (minor >= 3) {
        check.form("models.insert_offset", own.insert_offset);
        check.rows("models.insert_offset", own.insert_offset, own.name.rows());
    }
    if (minor >= 3) {
        check.form("models.radius", own.radius);
        check.rows("models.radius", own.radius, own.name.rows());
    }
    if (minor >= 3) {
        check.form("models.known", own.known);
        check.rows("models.known", own.known, own.name.rows());
    }
}

inline void check_files(Checks& check, const Files& own, std::size_t strings, unsigned minor) {
    if (minor >= 3) {
        check.form("files.name", own.name);
        check.indices("files.name", own.name, 0, strings, "strings");
    }
    if (minor >= 3) {
        check.form("files.folder", own.folder);
        check.rows("files.folder", own.folder, own.name.rows());
        check.indices("files.folder", own.folder, 0, strings, "strings");
    }
    if (minor >= 3) {
        check.form("files.found", own.found);
        check.rows("files.found", own.found, own.name.rows());
    }
    if (minor >= 3) check.form("files.sha256", own.sha256);
}

// The range check of every section. What it leaves without a fault leads nowhere outside its arrays.
inline void check_sections(Checks& check, const Sections& all, std::size_t strings, unsigned minor) {
    if (all.resources) check_resources(check, *all.resources, strings);
    if (all.geometry) check_geometry(check, *all.geometry, all, strings);
    if (all.templates) check_templates(check, *all.templates, strings, minor);
    if (all.things) check_things(check, *all.things, all, strings);
    if (all.cogs) check_cogs(check, *all.cogs, strings);
    if (all.visibility) check_visibility(check, *all.visibility, all);
    if (all.hotspots) check_hotspots(check, *all.hotspots, strings);
    if (all.lights) check_lights(check, *all.lights, all);
    if (all.particles) check_particles(check, *all.particles, strings);
    if (all.colour_effects) check_colour_effects(check, *all.colour_effects, all, strings);
    if (all.motion) check_motion(check, *all.motion);
    if (all.ledges) check_ledges(check, *all.ledges, all, strings, minor);
    if (all.basins) check_basins(check, *all.basins, all);
    if (all.models) check_models(check, *all.models, strings, minor);
    if (all.files) check_files(check, *all.files, strings, minor);
}

}  // namespace jklb
