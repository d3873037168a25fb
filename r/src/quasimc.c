/* The functions of QuasiMC's C interface that the package calls, for .Call(). */

#include <quasimc/capi.h>

#include <R.h>
#include <R_ext/Rdynload.h>
#include <Rinternals.h>

static void check(int status) {
    if (status != QUASIMC_DONE) {
        Rf_error("%s", quasimc_last_error());
    }
}

static void free_scene(SEXP handle) {
    quasimc_scene_free(R_ExternalPtrAddr(handle));
    R_ClearExternalPtr(handle);
}

static void free_result(SEXP handle) {
    quasimc_result_free(R_ExternalPtrAddr(handle));
    R_ClearExternalPtr(handle);
}

/* A handle that R frees when it is unreachable. */
static SEXP handle_of(void* pointer, R_CFinalizer_t finalizer) {
    SEXP handle = PROTECT(R_MakeExternalPtr(pointer, R_NilValue, R_NilValue));
    R_RegisterCFinalizerEx(handle, finalizer, TRUE);
    UNPROTECT(1);
    return handle;
}

static void* pointer_of(SEXP handle) {
    void* pointer = R_ExternalPtrAddr(handle);
    if (pointer == NULL) {
        Rf_error("a scene or result of another R session; make it again");
    }
    return pointer;
}

/* NULL for R's NULL. */
static const char* text_of(SEXP text) {
    return Rf_isNull(text) ? NULL : Rf_translateCharUTF8(Rf_asChar(text));
}

static SEXP text_from(const char* text) {
    if (text == NULL) {
        Rf_error("%s", quasimc_last_error());
    }
    return Rf_ScalarString(Rf_mkCharCE(text, CE_UTF8));
}

static SEXP new_scene(void) {
    quasimc_scene* scene = NULL;
    check(quasimc_scene_new(&scene));
    return handle_of(scene, free_scene);
}

static SEXP load_scene(SEXP file) {
    quasimc_scene* scene = NULL;
    check(quasimc_scene_load(text_of(file), &scene));
    return handle_of(scene, free_scene);
}

/* toml: a piece of a run file. */
static SEXP state(SEXP scene, SEXP toml) {
    check(quasimc_scene_state(pointer_of(scene), text_of(toml)));
    return R_NilValue;
}

static SEXP set_option(SEXP scene, SEXP key, SEXP value) {
    check(quasimc_scene_set_option(pointer_of(scene), text_of(key), text_of(value)));
    return R_NilValue;
}

/* vertices: matrix of 3 rows; faces: integer matrix of 3 rows, from 0; organs: a number for each. */
static SEXP scene_mesh(SEXP scene, SEXP vertices, SEXP faces, SEXP organs, SEXP material) {
    const int64_t count = XLENGTH(faces) / 3;
    int64_t* ids = NULL;
    if (!Rf_isNull(organs)) {
        ids = (int64_t*)R_alloc((size_t)count, sizeof *ids);
        for (int64_t i = 0; i < count; ++i) {
            ids[i] = (int64_t)REAL(organs)[i];
        }
    }
    check(quasimc_scene_add_mesh(pointer_of(scene), REAL(vertices), XLENGTH(vertices) / 3,
                                 INTEGER(faces), count, ids, text_of(material), NULL));
    return R_NilValue;
}

static SEXP set_name(SEXP scene, SEXP organ, SEXP name) {
    check(quasimc_scene_set_name(pointer_of(scene), (int64_t)Rf_asReal(organ), text_of(name)));
    return R_NilValue;
}

static SEXP set_label(SEXP scene, SEXP organ, SEXP key, SEXP value) {
    check(quasimc_scene_set_label(pointer_of(scene), (int64_t)Rf_asReal(organ), text_of(key),
                                  text_of(value)));
    return R_NilValue;
}

static void check_interrupt(void* unused) {
    (void)unused;
    R_CheckUserInterrupt();
}

/* Ends the run when the user interrupts R; the result is that of the paths until then. */
static int is_interrupted(double fraction, double seconds, double expected, void* user) {
    (void)fraction, (void)seconds, (void)expected, (void)user;
    return !R_ToplevelExec(check_interrupt, NULL);
}

static SEXP run(SEXP scene) {
    quasimc_result* result = NULL;
    check(quasimc_scene_run(pointer_of(scene), is_interrupted, NULL, &result));
    return handle_of(result, free_result);
}

typedef int (*ColumnReader)(const quasimc_result*, const char*, const char*, const char*, double*,
                            int64_t);

/* A quantity of all organs or groups. */
static SEXP column_of(ColumnReader read, SEXP result, int64_t count, SEXP quantity, SEXP band,
                      SEXP statistic) {
    SEXP values = PROTECT(Rf_allocVector(REALSXP, count));
    check(read(pointer_of(result), text_of(quantity), text_of(band), text_of(statistic),
               REAL(values), count));
    UNPROTECT(1);
    return values;
}

static SEXP get_organs(SEXP result, SEXP quantity, SEXP band, SEXP statistic) {
    return column_of(quasimc_result_get, result, quasimc_result_organ_count(pointer_of(result)),
                     quantity, band, statistic);
}

static SEXP get_groups(SEXP result, SEXP quantity, SEXP band, SEXP statistic) {
    return column_of(quasimc_result_get_groups, result,
                     quasimc_result_group_count(pointer_of(result)), quantity, band, statistic);
}

typedef int (*Reader)(const quasimc_result*, const char*, const char*, double*);

static SEXP four_of(Reader read, SEXP result, SEXP name, SEXP band) {
    SEXP values = PROTECT(Rf_allocVector(REALSXP, 4));
    check(read(pointer_of(result), text_of(name), text_of(band), REAL(values)));
    UNPROTECT(1);
    return values;
}

static SEXP get_total(SEXP result, SEXP quantity, SEXP band) {
    return four_of(quasimc_result_get_total, result, quantity, band);
}

static SEXP get_budget(SEXP result, SEXP item, SEXP band) {
    return four_of(quasimc_result_get_budget, result, item, band);
}

typedef const char* (*Naming)(const quasimc_result*, int64_t);

static SEXP texts_of(SEXP result, int64_t count, Naming name) {
    const quasimc_result* all = pointer_of(result);
    SEXP texts = PROTECT(Rf_allocVector(STRSXP, count));
    for (int64_t i = 0; i < count; ++i) {
        SET_STRING_ELT(texts, i, Rf_mkCharCE(name(all, i), CE_UTF8));
    }
    UNPROTECT(1);
    return texts;
}

static SEXP organ_names(SEXP result) {
    return texts_of(result, quasimc_result_organ_count(pointer_of(result)), quasimc_result_organ_name);
}

static SEXP band_names(SEXP result) {
    return texts_of(result, quasimc_result_band_count(pointer_of(result)), quasimc_result_band_name);
}

static SEXP band_units(SEXP result) {
    return texts_of(result, quasimc_result_band_count(pointer_of(result)), quasimc_result_band_unit);
}

static SEXP group_by(SEXP result) {
    return texts_of(result, quasimc_result_group_count(pointer_of(result)), quasimc_result_group_by);
}

static SEXP group_values(SEXP result) {
    return texts_of(result, quasimc_result_group_count(pointer_of(result)), quasimc_result_group_value);
}

static SEXP warning_texts(SEXP result) {
    return texts_of(result, quasimc_result_warning_count(pointer_of(result)), quasimc_result_warning);
}

static SEXP sensor_names(SEXP result) {
    return texts_of(result, quasimc_result_sensor_count(pointer_of(result)),
                    quasimc_result_sensor_name);
}

static SEXP set_names(SEXP result) {
    return texts_of(result, quasimc_result_sensor_set_count(pointer_of(result)),
                    quasimc_result_sensor_set_name);
}

static SEXP set_receiver(SEXP result, SEXP set) {
    return text_from(quasimc_result_sensor_set_receiver(pointer_of(result), text_of(set)));
}

/* Matrix of a row for each sensor: x, y, z. */
static SEXP sensor_positions(SEXP result) {
    const quasimc_result* all = pointer_of(result);
    const int64_t count = quasimc_result_sensor_count(all);
    double* positions = (double*)R_alloc((size_t)count, 3 * sizeof *positions);
    check(quasimc_result_sensor_positions(all, positions, count));
    SEXP rows = PROTECT(Rf_allocMatrix(REALSXP, (int)count, 3));
    for (int64_t i = 0; i < 3 * count; ++i) {
        REAL(rows)[i % 3 * count + i / 3] = positions[i];
    }
    UNPROTECT(1);
    return rows;
}

static SEXP set_size(SEXP result, SEXP set) {
    const int64_t size = quasimc_result_sensor_set_size(pointer_of(result), text_of(set));
    return Rf_ScalarInteger((int)size);
}

/* A quantity of all sensors of a set. */
static SEXP get_sensor_set(SEXP result, SEXP set, SEXP quantity, SEXP band, SEXP statistic) {
    const quasimc_result* all = pointer_of(result);
    const int64_t count = quasimc_result_sensor_set_size(all, text_of(set));
    if (count < 0) {
        Rf_error("%s", quasimc_last_error());
    }
    SEXP values = PROTECT(Rf_allocVector(REALSXP, count));
    check(quasimc_result_get_sensor_set(all, text_of(set), text_of(quantity), text_of(band),
                                        text_of(statistic), REAL(values), count));
    UNPROTECT(1);
    return values;
}

static SEXP organ_ids(SEXP result) {
    const quasimc_result* all = pointer_of(result);
    const int64_t count = quasimc_result_organ_count(all);
    SEXP ids = PROTECT(Rf_allocVector(REALSXP, count));
    for (int64_t i = 0; i < count; ++i) {
        REAL(ids)[i] = (double)quasimc_result_organ_id(all, i);
    }
    UNPROTECT(1);
    return ids;
}

static SEXP organ_areas(SEXP result) {
    const quasimc_result* all = pointer_of(result);
    const int64_t count = quasimc_result_organ_count(all);
    SEXP areas = PROTECT(Rf_allocVector(REALSXP, count));
    for (int64_t i = 0; i < count; ++i) {
        REAL(areas)[i] = quasimc_result_organ_area(all, i);
    }
    UNPROTECT(1);
    return areas;
}

typedef const char* (*Labelling)(const quasimc_result*, int64_t, const char*);

/* NA where an organ or sensor has no such label. */
static SEXP labels_of(SEXP result, int64_t count, Labelling label_of, SEXP key) {
    const quasimc_result* all = pointer_of(result);
    SEXP labels = PROTECT(Rf_allocVector(STRSXP, count));
    for (int64_t i = 0; i < count; ++i) {
        const char* label = label_of(all, i, text_of(key));
        SET_STRING_ELT(labels, i, label == NULL ? NA_STRING : Rf_mkCharCE(label, CE_UTF8));
    }
    UNPROTECT(1);
    return labels;
}

static SEXP organ_labels(SEXP result, SEXP key) {
    return labels_of(result, quasimc_result_organ_count(pointer_of(result)),
                     quasimc_result_organ_label, key);
}

static SEXP sensor_labels(SEXP result, SEXP key) {
    return labels_of(result, quasimc_result_sensor_count(pointer_of(result)),
                     quasimc_result_sensor_label, key);
}

static SEXP quantity_names(void) {
    const int64_t count = quasimc_quantity_count();
    SEXP names = PROTECT(Rf_allocVector(STRSXP, count));
    for (int64_t i = 0; i < count; ++i) {
        SET_STRING_ELT(names, i, Rf_mkCharCE(quasimc_quantity_name(i), CE_UTF8));
    }
    UNPROTECT(1);
    return names;
}

static SEXP run_number(SEXP result, SEXP key) {
    double value = 0;
    check(quasimc_result_get_number(pointer_of(result), text_of(key), &value));
    return Rf_ScalarReal(value);
}

static SEXP run_text(SEXP result, SEXP key) {
    return text_from(quasimc_result_text(pointer_of(result), text_of(key)));
}

#define ENTRY(name, arguments) {#name, (DL_FUNC)&name, arguments}
static const R_CallMethodDef kEntries[] = {
    ENTRY(new_scene, 0),    ENTRY(load_scene, 1),   ENTRY(state, 2),         ENTRY(set_option, 3),
    ENTRY(scene_mesh, 5),   ENTRY(set_name, 3),     ENTRY(set_label, 4),     ENTRY(run, 1),
    ENTRY(get_organs, 4),   ENTRY(get_groups, 4),   ENTRY(get_total, 3),     ENTRY(get_budget, 3),
    ENTRY(organ_names, 1),  ENTRY(band_names, 1),   ENTRY(band_units, 1),    ENTRY(group_by, 1),
    ENTRY(group_values, 1), ENTRY(warning_texts, 1), ENTRY(organ_ids, 1),    ENTRY(organ_areas, 1),
    ENTRY(organ_labels, 2), ENTRY(quantity_names, 0), ENTRY(run_number, 2),  ENTRY(run_text, 2),
    ENTRY(sensor_names, 1), ENTRY(set_names, 1),    ENTRY(sensor_positions, 1), ENTRY(sensor_labels, 2),
    ENTRY(get_sensor_set, 5), ENTRY(set_receiver, 2), ENTRY(set_size, 2), {NULL, NULL, 0}};

void R_init_quasimc(DllInfo* library) {
    R_registerRoutines(library, NULL, kEntries, NULL, NULL);
    R_useDynamicSymbols(library, FALSE);
}
