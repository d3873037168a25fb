# Scenes: the tables of a run file, and meshes.

# A scene without organs. bands: names, or units by name: c(PAR = "umol m-2 s-1", NIR = "W m-2").
# ...: other keys at the top of a run file, as length_unit = "m", up = "z".
quasimc_scene <- function(bands = "PAR", ...) {
    scene <- structure(list(handle = .Call(C_new_scene)), class = "quasimc_scene")
    if (is.null(names(bands))) {
        return(set(scene, NULL, bands = as.list(bands), ...))
    }
    for (name in names(bands)) {
        add(scene, "band", name = name, unit = bands[[name]])
    }
    set(scene, NULL, ...)
}

# The scene of a run file, with its sources and options.
quasimc_load <- function(file) {
    structure(list(handle = .Call(C_load_scene, path.expand(file))), class = "quasimc_scene")
}

# Adds a table of a run file to a list of tables:
# add(scene, "material", name = "leaf", reflectance = 0.08).
add <- function(scene, table, ...) {
    state(scene, paste0("[[", table, "]]\n", toml_lines(list(...))))
}

# Sets keys of a table of a run file, or, without a table, at its top:
# set(scene, "cell", x = c(0, 1), y = c(0, 1)).
set <- function(scene, table = NULL, ...) {
    head <- if (is.null(table)) "" else paste0("[", table, "]\n")
    state(scene, paste0(head, toml_lines(list(...))))
}

# Adds organs made of triangles.
# vertices: matrix (n, 3); faces: matrix (m, 3) of rows of vertices; organ: the id of each face's
# organ, m numbers, NULL: one organ with the next free id; names, labels: texts by id,
# c("1" = "leaf 1"), list(plant = c("1" = 12)).
add_mesh <- function(scene, vertices, faces, material, organ = NULL, names = NULL, labels = list()) {
    vertices <- t(as.matrix(vertices))
    faces <- t(as.matrix(faces))
    if (nrow(vertices) != 3 || nrow(faces) != 3) {
        stop("vertices and faces have three columns each")
    }
    storage.mode(vertices) <- "double"
    faces <- matrix(as.integer(faces - 1), nrow = 3)
    if (!is.null(organ)) {
        organ <- as.double(organ)
        if (length(organ) != ncol(faces)) {
            stop("organ has ", length(organ), " numbers; there are ", ncol(faces), " faces")
        }
    }
    if (is.null(organ) && (length(names) > 0 || length(labels) > 0)) {
        stop("names and labels belong to ids; give organ, the id of each face's organ")
    }
    .Call(C_scene_mesh, scene$handle, vertices, faces, organ, material)
    for (id in base::names(names)) {
        .Call(C_set_name, scene$handle, as.double(id), as.character(names[[id]]))
    }
    for (key in base::names(labels)) {
        for (id in base::names(labels[[key]])) {
            .Call(C_set_label, scene$handle, as.double(id), key, as.character(labels[[key]][[id]]))
        }
    }
    invisible(scene)
}

# Adds points at which light is measured, which shade nothing: a set of sensors.
# positions: matrix (n, 3), or three numbers; ...: other keys of [[sensors]] in run files, as
# facing = "down", receiver = "sphere", field_of_view_deg = 30, average = TRUE. For a regular array:
# add(scene, "sensors", name = "bench", at = list(start = c(0, 0, 1), along = c(7, 0, 0), ...)).
add_sensors <- function(scene, positions, name = "sensors", ...) {
    positions <- if (is.null(dim(positions))) matrix(positions, 1) else as.matrix(positions)
    if (ncol(positions) != 3) {
        stop("positions has three columns")
    }
    rows <- lapply(seq_len(nrow(positions)), function(i) as.numeric(positions[i, ]))
    add(scene, "sensors", name = name, at = rows, ...)
}

# Computes the light on every organ. ...: options of the run, as paths = 4096, target_error = 0.01.
# Interrupting it gives the result of the paths until then.
light <- function(scene, ...) {
    options <- list(...)
    for (key in names(options)) {
        .Call(C_set_option, scene$handle, key, option_text(options[[key]]))
    }
    result <- structure(list(handle = .Call(C_run, scene$handle)), class = "quasimc_result")
    for (text in .Call(C_warning_texts, result$handle)) {
        warning(text, call. = FALSE)
    }
    result
}

print.quasimc_scene <- function(x, ...) {
    cat("<scene of QuasiMC: light(scene) computes its light>\n")
    invisible(x)
}

state <- function(scene, toml) {
    .Call(C_state, scene$handle, toml)
    invisible(scene)
}

option_text <- function(value) {
    if (is.logical(value)) tolower(as.character(value)) else paste(format_number(value), collapse = ",")
}

format_number <- function(value) {
    if (is.numeric(value)) format(value, digits = 17, trim = TRUE, scientific = NA) else as.character(value)
}

# Keys and values of a table as TOML.
toml_lines <- function(keys) {
    if (length(keys) == 0) {
        return("")
    }
    if (is.null(names(keys)) || any(names(keys) == "")) {
        stop("every value needs the name of its key: reflectance = 0.1")
    }
    paste0(names(keys), " = ", vapply(keys, toml_value, ""), "\n", collapse = "")
}

toml_value <- function(value) {
    if (is.list(value) && !is.null(names(value))) {
        return(paste0("{ ", paste0(names(value), " = ", vapply(value, toml_value, ""), collapse = ", "), " }"))
    }
    if (is.list(value) || length(value) != 1) {
        return(paste0("[", paste(vapply(as.list(value), toml_value, ""), collapse = ", "), "]"))
    }
    if (is.na(value)) {
        stop("a value is missing (NA)")
    }
    if (is.logical(value)) {
        return(tolower(as.character(value)))
    }
    if (is.numeric(value)) format_number(value) else toml_text(as.character(value))
}

toml_text <- function(text) {
    text <- gsub("\\", "\\\\", enc2utf8(text), fixed = TRUE)
    text <- gsub("\"", "\\\"", text, fixed = TRUE)
    paste0("\"", gsub("\n", "\\n", text, fixed = TRUE), "\"")
}
