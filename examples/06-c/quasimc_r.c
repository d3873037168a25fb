/* The functions of the C interface that leaves.R calls, for R's .Call().
 * R CMD SHLIB makes a library of it. */

#include <quasimc/capi.h>

#include <R.h>
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

static const char* text_of(SEXP text) {
    return Rf_translateCharUTF8(Rf_asChar(text));
}

/* A scene from a piece of a run file: text. */
SEXP r_new_scene(SEXP toml) {
    quasimc_scene* scene = NULL;
    check(quasimc_scene_new(&scene));
    SEXP handle = PROTECT(handle_of(scene, free_scene));
    check(quasimc_scene_state(scene, text_of(toml)));
    UNPROTECT(1);
    return handle;
}

/* vertices: matrix of 3 rows; faces: integer matrix of 3 rows, from 0; organs: integers. */
SEXP r_add_mesh(SEXP scene, SEXP vertices, SEXP faces, SEXP organs, SEXP material) {
    const int count = Rf_length(faces) / 3;
    int64_t* ids = (int64_t*)R_alloc((size_t)count, sizeof *ids);
    for (int i = 0; i < count; ++i) {
        ids[i] = INTEGER(organs)[i];
    }
    check(quasimc_scene_add_mesh(R_ExternalPtrAddr(scene), REAL(vertices), Rf_length(vertices) / 3,
                                 INTEGER(faces), count, ids, text_of(material), NULL));
    return R_NilValue;
}

SEXP r_set_name(SEXP scene, SEXP organ, SEXP name) {
    check(quasimc_scene_set_name(R_ExternalPtrAddr(scene), Rf_asInteger(organ), text_of(name)));
    return R_NilValue;
}

SEXP r_run(SEXP scene) {
    quasimc_result* result = NULL;
    check(quasimc_scene_run(R_ExternalPtrAddr(scene), NULL, NULL, &result));
    return handle_of(result, free_result);
}

SEXP r_get(SEXP result, SEXP quantity, SEXP band, SEXP statistic) {
    const quasimc_result* all = R_ExternalPtrAddr(result);
    const int64_t count = quasimc_result_organ_count(all);
    SEXP values = PROTECT(Rf_allocVector(REALSXP, count));
    check(quasimc_result_get(all, text_of(quantity), text_of(band), text_of(statistic),
                             REAL(values), count));
    UNPROTECT(1);
    return values;
}

SEXP r_organ_names(SEXP result) {
    const quasimc_result* all = R_ExternalPtrAddr(result);
    const int64_t count = quasimc_result_organ_count(all);
    SEXP names = PROTECT(Rf_allocVector(STRSXP, count));
    for (int64_t i = 0; i < count; ++i) {
        SET_STRING_ELT(names, i, Rf_mkCharCE(quasimc_result_organ_name(all, i), CE_UTF8));
    }
    UNPROTECT(1);
    return names;
}
