#pragma once

/* QuasiMC in plain C, for programs in C and in all languages that can call C:
 * docs/guide/libraries.md shows how.
 *
 * The interface uses numbers, texts, arrays and three kinds of handles. Nothing is thrown across
 * this interface. Functions that can fail return a quasimc_status, and quasimc_last_error() then
 * describes the error. Texts are UTF-8 and end in a zero byte; those returned live as long as the
 * handle that they belong to, and are never NULL unless documented. A handle is for one thread
 * at a time; different handles may be used concurrently. Freeing NULL does nothing. */

/* Not the C++ headers of these names: a C compiler has none of those. */
#include <stdint.h> /* NOLINT(modernize-deprecated-headers) */

#ifdef __cplusplus
extern "C" {
#endif

/** Changes when a program that was compiled for another number no longer works. */
#define QUASIMC_ABI_VERSION 2

/** Input of a run: organs, materials, light and options. */
typedef struct quasimc_scene quasimc_scene;
/** A canopy whose organs change from step to step. */
typedef struct quasimc_growth quasimc_growth;
/** The light on every organ. */
typedef struct quasimc_result quasimc_result;

/** Return values of functions. The same numbers are exit statuses of the program. */
enum quasimc_status {
    QUASIMC_DONE = 0,
    QUASIMC_INPUT_ERROR = 1,    /**< an error in the input; all errors are listed, one per line */
    QUASIMC_MISUSE = 2,         /**< a NULL, an impossible count, an unknown index or name, or a
                                     handle in use */
    QUASIMC_INTERNAL_ERROR = 3, /**< a bug, or out of memory */
    QUASIMC_STOPPED = 4         /**< a run ended before there was a result */
};

/** The parts of a scene, for quasimc_scene_clear(). */
enum quasimc_part {
    QUASIMC_BANDS = 0,
    QUASIMC_MATERIALS = 1,
    QUASIMC_ORGANS = 2, /**< from quasimc_scene_add_mesh(), run files and geometry files */
    QUASIMC_GROUND = 3,
    QUASIMC_CELL = 4,
    QUASIMC_SITE = 5, /**< site of the scene on the Earth */
    QUASIMC_SOURCES = 6,
    QUASIMC_TIME = 7,      /**< the times of a run file, and the control of lamps */
    QUASIMC_SWEEP = 8,     /**< the sweep of a run file */
    QUASIMC_DETECTORS = 9, /**< detectors of light other than organs */
    QUASIMC_OPTIONS = 10,  /**< options of the run, which return to their defaults */
    QUASIMC_OTHER = 11,    /**< format, title, up, north, length_unit, irradiance_unit, [output] */
    QUASIMC_UNKNOWN_KEYS = 12, /**< keys at the top of a run file that do not exist */
    QUASIMC_SENSORS = 13       /**< points at which light is measured */
};

/** Receives the progress of a run from time to time, in the calling thread.
 *  @param fraction  completed fraction of the run, 0 to 1
 *  @param seconds  elapsed time
 *  @param expected_seconds  expected total time; grows when a target needs more paths
 *  @param user  the pointer given with the function
 *  @returns 0 to go on; anything else ends the run, with the result of the completed part
 */
typedef int (*quasimc_progress)(
    double fraction, double seconds, double expected_seconds, void* user);

/* ---- The library ---- */

/** QUASIMC_ABI_VERSION of the library. */
int quasimc_abi_version(void);
/** "major.minor.patch". */
const char* quasimc_version(void);
/** Error of the last failed call in this thread; "" if none failed. Valid until the next call. */
const char* quasimc_last_error(void);

/* ---- Scenes: everything has the names of the run file, docs/reference/run-file.md ----
 *
 * Input is checked together, when the scene is run or a growth is made of it; by
 * themselves calls reject pointers, counts, texts that are no TOML, unknown options, and
 * faces with unknown vertices. Input that a run then rejects is removed by quasimc_scene_clear,
 * and given anew.
 *
 * Bands come first, by quasimc_scene_add_band() or in a piece of a run file. Arrays of reflectance,
 * transmittance, irradiance and power have as many numbers as the scene has bands at the call; a
 * scene without bands rejects them. */

/** An empty scene. Paths of files are relative to the current folder. */
int quasimc_scene_new(quasimc_scene** scene);
/** The scene of a run file, whose [output] is ignored. */
int quasimc_scene_load(const char* run_file, quasimc_scene** scene);
void quasimc_scene_free(quasimc_scene* scene);

/** Adds a piece of a run file (TOML). Tables are merged with previous input, lists
 *  of tables ([[material]], [[source]], [[organ]], ...) are appended, single values replaced. */
int quasimc_scene_state(quasimc_scene* scene, const char* toml);
/** Removes a part of the input, if there is any. @param part  a quasimc_part */
int quasimc_scene_clear(quasimc_scene* scene, int part);

/** Adds a waveband. @param unit  of irradiance; NULL or "": W m-2 */
int quasimc_scene_add_band(quasimc_scene* scene, const char* name, const char* unit);
/** Adds a material with equal sides, or replaces that of the same name.
 *  @param reflectance, transmittance  per band, 0 to 1; one of them may be NULL: 0 */
int quasimc_scene_add_material(
    quasimc_scene* scene, const char* name, const double* reflectance, const double* transmittance);
/** Adds organs made of triangles, in the order of their ids, after all previous ones. The
 *  arrays are copied.
 *  @param vertices  x, y, z of each: 3 * vertex_count numbers
 *  @param faces  three numbers of vertices each, from 0: 3 * face_count; NULL: every three vertices
 *         are a face, and face_count is a third of vertex_count
 *  @param organ_of_face  ids, face_count numbers; NULL: one organ, with the next id that is free
 *  @param materials  a name, or several with a line break between them
 *  @param material_of_face  which of these, from 0: face_count numbers; NULL: the first, of all */
int quasimc_scene_add_mesh(
    quasimc_scene* scene,
    const double* vertices,
    int64_t vertex_count,
    const int32_t* faces,
    int64_t face_count,
    const int64_t* organ_of_face,
    const char* materials,
    const int32_t* material_of_face);
/** Names an organ that quasimc_scene_add_mesh was given with this id. */
int quasimc_scene_set_name(quasimc_scene* scene, int64_t organ, const char* name);
/** Labels it: "plant" = "3". */
int quasimc_scene_set_label(
    quasimc_scene* scene, int64_t organ, const char* key, const char* value);
/** Sets a horizontal ground: under the canopy, or of the whole cell. */
int quasimc_scene_set_ground(quasimc_scene* scene, const char* material, double height);
/** Repeats the scene periodically along x and y. */
int quasimc_scene_set_cell(
    quasimc_scene* scene, double x_low, double x_high, double y_low, double y_high);
/** Sets the site of the scene, for suns by time: degrees, north and east positive; m. */
int quasimc_scene_set_site(
    quasimc_scene* scene, double latitude_deg, double longitude_deg, double elevation_m);

/* Sources. Irradiance and power: one number for each band, in its unit. */

/** Parallel light that travels along (x, y, z). @param irradiance_facing  on a plane across it */
int quasimc_scene_add_directional(
    quasimc_scene* scene, double x, double y, double z, const double* irradiance_facing);
/** The sun. @param azimuth_deg  clockwise from north */
int quasimc_scene_add_sun(
    quasimc_scene* scene,
    double azimuth_deg,
    double elevation_deg,
    const double* irradiance_facing);
/** The sun at a time, "2024-06-21T12:00:00+02:00"; the scene needs a site. */
int quasimc_scene_add_sun_at(
    quasimc_scene* scene, const char* time, const double* irradiance_facing);
/** A sky without parameters except the first sun: "uniform", "cie_overcast", ... */
int quasimc_scene_add_sky(
    quasimc_scene* scene, const char* model, const double* irradiance_horizontal);
/** An isotropic lamp. @param power  W, or umol s-1 for bands in umol m-2 s-1 */
int quasimc_scene_add_point_lamp(
    quasimc_scene* scene, double x, double y, double z, const double* power);

/* Sensors: points at which light is measured. They shade nothing and change no other number. Each
 * set has a name, and its sensors are "name 1", "name 2", ... Flat ones face upwards. */

/** Adds a set of sensors. @param positions  x, y, z of each: 3 * count numbers */
int quasimc_scene_add_sensors(
    quasimc_scene* scene, const char* name, const double* positions, int64_t count);
/** Adds a regular array of sensors, in the centres of the equal parts of a parallelogram. The index
 *  along the first edge changes fastest; labels "i" and "j" count from 1.
 *  @param start  x, y, z of a corner
 *  @param along, across  x, y, z of the edges; across may be NULL: sensors on a line
 *  @param count_along, count_across  numbers of sensors along the edges */
int quasimc_scene_add_sensor_grid(
    quasimc_scene* scene,
    const char* name,
    const double* start,
    const double* along,
    const double* across,
    int64_t count_along,
    int64_t count_across);
/** Sets a key of a set of sensors, "[[sensors]]" in docs/reference/run-file.md.
 *  @param name  of the set
 *  @param key, value  "facing" "down" or "[0, -1, 1]", "receiver" "sphere", "field_of_view_deg"
 *         "30", "size" "0.05", "average" "true", "labels" "{ row = 1 }", ... */
int quasimc_scene_set_sensors(
    quasimc_scene* scene, const char* name, const char* key, const char* value);

/** Sets an option of the run, docs/reference/options.md: "paths" "4096", "method" "auto". */
int quasimc_scene_set_option(quasimc_scene* scene, const char* key, const char* value);

/** Computes the light on every organ. Unchanged parts of the last run are reused.
 *  The bits of the result are those of the program.
 *  @param progress  may be NULL; it must not use the scene
 *  @param result  to be freed by the caller; of a single time: [time] and [sweep] are rejected,
 *         and can be removed (quasimc_scene_clear) */
int quasimc_scene_run(
    quasimc_scene* scene, quasimc_progress progress, void* user, quasimc_result** result);

/* ---- Growth ---- */

/** A canopy that begins with the scene. Sources and options of a step are those that the
 *  scene has then. The scene must not be freed before the growth. */
int quasimc_growth_new(quasimc_scene* scene, quasimc_growth** growth);
void quasimc_growth_free(quasimc_growth* growth);
/** Adds organs after the others; as quasimc_scene_add_mesh, but ids must be given. All or
 *  none: an id that an organ of the growth or of its scene has is an input error. */
int quasimc_growth_add_mesh(
    quasimc_growth* growth,
    const double* vertices,
    int64_t vertex_count,
    const int32_t* faces,
    int64_t face_count,
    const int64_t* organ_of_face,
    const char* materials,
    const int32_t* material_of_face);
/** Replaces the organs of the same ids, all or none. An id that was not added to the
 *  growth is an input error. */
int quasimc_growth_change_mesh(
    quasimc_growth* growth,
    const double* vertices,
    int64_t vertex_count,
    const int32_t* faces,
    int64_t face_count,
    const int64_t* organ_of_face,
    const char* materials,
    const int32_t* material_of_face);
/** Removes an organ that was added to the growth. */
int quasimc_growth_remove(quasimc_growth* growth, int64_t organ);
/** Takes over changes of the scene other than sources and options: materials, ground, ... Nothing
 *  is taken over if one of its organs now has the id of an organ of the growth. */
int quasimc_growth_update_scene(quasimc_growth* growth);
/** The light of this step: the bits of a single run of the same organs in the same order, and its
 *  warnings. */
int quasimc_growth_run(
    quasimc_growth* growth, quasimc_progress progress, void* user, quasimc_result** result);

/* ---- Results. They are independent of scene and growth. ---- */

void quasimc_result_free(quasimc_result* result);

/** Organs in the order of the scene, the ground, if any, last; counted from 0. */
int64_t quasimc_result_organ_count(const quasimc_result* result);
/** -1 and an error if there is no such organ. */
int64_t quasimc_result_organ_id(const quasimc_result* result, int64_t organ);
/** The index of the organ with an id; -1 if there is none. */
int64_t quasimc_result_find_organ(const quasimc_result* result, int64_t id);
/** NULL and an error if there is no such organ. */
const char* quasimc_result_organ_name(const quasimc_result* result, int64_t organ);
/** NULL if it has no such label. */
const char* quasimc_result_organ_label(
    const quasimc_result* result, int64_t organ, const char* key);
/** One-sided; square units of length. -1 and an error if there is no such organ. */
double quasimc_result_organ_area(const quasimc_result* result, int64_t organ);

int64_t quasimc_result_band_count(const quasimc_result* result);
/** NULL and an error if there is no such band. */
const char* quasimc_result_band_name(const quasimc_result* result, int64_t band);
const char* quasimc_result_band_unit(const quasimc_result* result, int64_t band);

/** The quantities of organs and bands: "absorbed_flux", ... */
int64_t quasimc_quantity_count(void);
/** NULL and an error if there is no such quantity. */
const char* quasimc_quantity_name(int64_t quantity);

/** A number of every organ.
 *  @param quantity  a name of quasimc_quantity_name(), with "_from_sun" for the part that came from
 *         that origin, if the run has origins; with sun_shade = "apart" a quantity of sunlit and
 *         shaded parts, "incident_upper_sunlit"; "sunlit_fraction", with sun_shade also "_upper"
 * and
 *         "_lower"; or a requested ratio, "R:FR"
 *  @param band  its name; NULL for the latter two
 *  @param statistic  "mean", "standard_error", or "ci95_low" and "ci95_high", the ends of the 95 %
 * interval, which contains the mean and only physically possible values
 *  @param values  room for `count` numbers
 *  @param count  quasimc_result_organ_count() */
int quasimc_result_get(
    const quasimc_result* result,
    const char* quantity,
    const char* band,
    const char* statistic,
    double* values,
    int64_t count);
/** A number of one organ, given by its id, as quasimc_result_get.
 *  @param values  room for four: mean, standard error, ci95_low, ci95_high */
int quasimc_result_get_organ(
    const quasimc_result* result,
    int64_t id,
    const char* quantity,
    const char* band,
    double* values);
/** A sum (or mean per area) over all organs except the ground, with its own error.
 *  @param values  room for four: mean, standard error, ci95_low, ci95_high */
int quasimc_result_get_total(
    const quasimc_result* result, const char* quantity, const char* band, double* values);
/** The energy budget of a band. @param item  "emitted", "absorbed_by_organs",
 *  "absorbed_by_ground", "escaped", "cut_off" or "imbalance". @param values  room for four */
int quasimc_result_get_budget(
    const quasimc_result* result, const char* item, const char* band, double* values);

/** Groups of organs: the first is all of them, then those of the options groups and layers. */
int64_t quasimc_result_group_count(const quasimc_result* result);
/** "all", the key of a label, or "layer"; NULL and an error if there is no such group. */
const char* quasimc_result_group_by(const quasimc_result* result, int64_t group);
/** The value of the label, or the name of the layer. */
const char* quasimc_result_group_value(const quasimc_result* result, int64_t group);
/** A number of every group, as quasimc_result_get. */
int quasimc_result_get_groups(
    const quasimc_result* result,
    const char* quantity,
    const char* band,
    const char* statistic,
    double* values,
    int64_t count);

/** Sensors ([[sensors]]): the number of their results. 0 without sensors, and if the run
 *  was stopped before their light was computed. */
int64_t quasimc_result_sensor_count(const quasimc_result* result);
/** NULL and an error if there is no such sensor. */
const char* quasimc_result_sensor_name(const quasimc_result* result, int64_t sensor);
/** NULL if it has no such label; "sensors": the name of its set. */
const char* quasimc_result_sensor_label(
    const quasimc_result* result, int64_t sensor, const char* key);
/** The position of every sensor; the mean of averaged ones.
 *  @param positions  room for 3 * count numbers: x, y, z of each
 *  @param count  quasimc_result_sensor_count() */
int quasimc_result_sensor_positions(const quasimc_result* result, double* positions, int64_t count);
/** A number of every sensor, as quasimc_result_get; the light on a sphere is its incident_upper.
 *  "transmittance": incident_upper over the light on the horizontal above the canopy. NaN of
 *  sensors that do not face up, and where that light is 0 or unknown.
 *  @param values  room for `count` numbers
 *  @param count  quasimc_result_sensor_count() */
int quasimc_result_get_sensors(
    const quasimc_result* result,
    const char* quantity,
    const char* band,
    const char* statistic,
    double* values,
    int64_t count);

/** The number of sets of sensors. The results of a set follow one another, in the order of the
 *  sets. */
int64_t quasimc_result_sensor_set_count(const quasimc_result* result);
/** NULL and an error if there is no such set. */
const char* quasimc_result_sensor_set_name(const quasimc_result* result, int64_t set);
/** The number of results of a set: of its sensors, or 1 for their average. -1 and an error if there
 *  is no set of the name. */
int64_t quasimc_result_sensor_set_size(const quasimc_result* result, const char* set);
/** "cosine" or "sphere". NULL and an error if there is no set of the name. */
const char* quasimc_result_sensor_set_receiver(const quasimc_result* result, const char* set);
/** A number of every sensor of a set, as quasimc_result_get_sensors. Spheres have "fluence_rate"
 *  instead of the two sides.
 *  @param set  its name
 *  @param values  room for `count` numbers
 *  @param count  quasimc_result_sensor_set_size() */
int quasimc_result_get_sensor_set(
    const quasimc_result* result,
    const char* set,
    const char* quantity,
    const char* band,
    const char* statistic,
    double* values,
    int64_t count);
/** A number of one sensor, as quasimc_result_get_sensor_set.
 *  @param index  in its set, from 0
 *  @param values  room for four: mean, standard error, ci95_low, ci95_high */
int quasimc_result_get_sensor(
    const quasimc_result* result,
    const char* set,
    int64_t index,
    const char* quantity,
    const char* band,
    double* values);

/** Detectors, in the order in which they were added. */
int64_t quasimc_result_detector_count(const quasimc_result* result);
/** NULL and an error if there is no such detector. */
const char* quasimc_result_detector_name(const quasimc_result* result, int64_t detector);
/** The number of bins of a detector. -1 and an error if there is no detector of the name.
 */
int64_t quasimc_result_detector_bin_count(const quasimc_result* result, const char* detector);
/** The range of a bin: "0 to 20". NULL and an error if there is no such detector or bin. */
const char* quasimc_result_detector_bin(
    const quasimc_result* result, const char* detector, int64_t bin);
/** The flux in every bin of a detector: unit of the band times square units of length.
 *  @param statistic  as of quasimc_result_get
 *  @param values  room for `count` numbers
 *  @param count  quasimc_result_detector_bin_count() */
int quasimc_result_get_detector(
    const quasimc_result* result,
    const char* detector,
    const char* band,
    const char* statistic,
    double* values,
    int64_t count);

/** A number of the run: "paths" (per replicate), "replicates", "rays", "fraction_at_target",
 *  "preparation_seconds", "solve_seconds", "solve_cpu_seconds". */
int quasimc_result_get_number(const quasimc_result* result, const char* key, double* value);
/** Number of rounds of a run with a target error or a limit of paths; 0: a single round. */
int64_t quasimc_result_round_count(const quasimc_result* result);
/** A number after a round. @param key  "paths" (per replicate, of all rounds up to it),
 *  "seconds" (since the run began), "median_error", "worst_error" (relative standard errors over
 *  organs and bands; NaN: no light was sampled), "fraction_at_target" */
int quasimc_result_get_round(
    const quasimc_result* result, int64_t round, const char* key, double* value);
/** A text of the run: "method", "reason", "stop". NULL and an error if there is no such text. */
const char* quasimc_result_text(const quasimc_result* result, const char* key);
/** Number of warnings: input that is allowed but probably not meant. */
int64_t quasimc_result_warning_count(const quasimc_result* result);
/** NULL and an error if there is no such warning. */
const char* quasimc_result_warning(const quasimc_result* result, int64_t warning);

#ifdef __cplusplus
}
#endif
