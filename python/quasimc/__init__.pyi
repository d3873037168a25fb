import datetime
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, MutableMapping, MutableSequence, Sequence
from pathlib import Path
from typing import Any, Literal, TypeVar, Union, overload

import numpy as np
import numpy.typing as npt

from . import sources as sources

__version__: str

Numbers = Union[float, Sequence[float], Mapping[str, float]]
Instant = Union[str, datetime.datetime]
Date = Union[str, datetime.date]
Interval = Sequence[float]
Array = npt.NDArray[np.float64]
PerOrgan = Union[str, int, Mapping[int, object], Sequence[object], npt.NDArray[Any]]

class Error(Exception): ...

class InputError(Error, ValueError):
    faults: list[dict[str, str]]
    def __init__(self, text: str, faults: list[dict[str, str]]) -> None: ...

class KeywordError(InputError, TypeError): ...

class Stopped(Error, RuntimeError):
    why: str
    def __init__(self, text: str, why: str) -> None: ...

class QuasimcWarning(UserWarning): ...

class Progress:
    fraction: float
    seconds: float
    expected_seconds: float
    fraction_at_target: float
    def __init__(
        self, fraction: float, seconds: float, expected_seconds: float, fraction_at_target: float
    ) -> None: ...

_V = TypeVar("_V", bound="_Value")

class _Value:
    def table(self) -> dict[str, Any]: ...
    def replace(self: _V, **keys: Any) -> _V: ...
    def __eq__(self, other: object) -> bool: ...

class Source(_Value):
    def __init__(self, type: str, **keys: Any) -> None: ...
    def __getattr__(self, key: str) -> Any: ...

def source_types() -> dict[str, str]: ...
def sky_models() -> dict[str, str]: ...
def directional(
    *,
    direction: Sequence[float] | npt.NDArray[Any] | None = None,
    azimuth_deg: float | None = None,
    elevation_deg: float | None = None,
    irradiance_facing: Numbers | None = None,
    irradiance_horizontal: Numbers | None = None,
    name: str | None = None,
    on_hours: Sequence[Any] | None = None,
) -> Source: ...
def sun(
    *,
    time: Instant | None = None,
    azimuth_deg: float | None = None,
    elevation_deg: float | None = None,
    disk: bool | None = None,
    irradiance_facing: Numbers | None = None,
    irradiance_horizontal: Numbers | None = None,
    delta_t_s: float | None = None,
    name: str | None = None,
) -> Source: ...
def sky(
    model: str = "cie_overcast",
    *,
    irradiance_horizontal: Numbers,
    name: str | None = None,
    **keys: Any,
) -> Source: ...
def uniform_sky(*, irradiance_horizontal: Numbers, name: str | None = None) -> Source: ...
def lamp(
    type: str,
    *,
    power: Numbers | None = None,
    photon_flux: Numbers | None = None,
    luminous_flux: Numbers | None = None,
    name: str | None = None,
    on_hours: Sequence[Any] | None = None,
    **keys: Any,
) -> Source: ...

class SunPosition:
    azimuth_deg: float
    elevation_deg: float
    true_elevation_deg: float
    zenith_deg: float
    distance_au: float
    declination_deg: float
    equation_of_time_min: float
    def __init__(self, position: Any) -> None: ...
    @property
    def vector(self) -> tuple[float, float, float]: ...

def sun_position(
    latitude_deg: float,
    longitude_deg: float,
    time: Instant,
    *,
    elevation_m: float = 0.0,
    pressure_hpa: float | None = None,
    temperature_c: float = 12.0,
    delta_t_s: float | None = None,
) -> SunPosition: ...
def sun_day(
    latitude_deg: float, longitude_deg: float, date: Date, *, elevation_m: float = 0.0
) -> dict[str, Any]: ...

Number = Union[float, int, npt.NDArray[Any]]
Mask = Union[npt.NDArray[np.bool_], Sequence[bool]]
Rows = Union[int, str, slice, npt.NDArray[Any], Sequence[int], Sequence[bool]]
Bools = npt.NDArray[np.bool_]

class Estimates:
    name: str
    bands: tuple[str, ...]
    index: Any
    extensive: bool
    def __init__(
        self,
        values: Array,
        name: str,
        unit: str | tuple[str, ...],
        bands: Sequence[str] = (),
        *,
        index: Any = None,
        source: Any = None,
        origins: Mapping[str, Callable[[], Estimates]] | None = None,
        extensive: bool = True,
    ) -> None: ...
    @property
    def values(self) -> Array: ...
    @property
    def standard_error(self) -> Array: ...
    @property
    def ci95_low(self) -> Array: ...
    @property
    def ci95_high(self) -> Array: ...
    @property
    def relative_error(self) -> Array: ...
    @property
    def shape(self) -> tuple[int, ...]: ...
    @property
    def ndim(self) -> int: ...
    @property
    def size(self) -> int: ...
    @property
    def unit(self) -> str: ...
    @property
    def units(self) -> dict[str, str]: ...
    @property
    def has_replicates(self) -> bool: ...
    @property
    def origins(self) -> tuple[str, ...]: ...
    def with_unit(self, unit: str) -> Estimates: ...
    def __getitem__(self, key: Rows | tuple[Rows, ...]) -> Estimates: ...
    def at(self, key: object) -> Estimates: ...
    def where(self, mask: Mask) -> Estimates: ...
    def origin(self, name: str) -> Estimates: ...
    def sum(
        self,
        axis: int | str | None = None,
        dtype: None = None,
        out: None = None,
        *,
        where: Mask | None = None,
        weights: npt.ArrayLike | None = None,
    ) -> Estimates: ...
    def mean(
        self,
        axis: int | str | None = None,
        dtype: None = None,
        out: None = None,
        *,
        where: Mask | None = None,
    ) -> Estimates: ...
    def average(
        self,
        weights: str | npt.ArrayLike = "area",
        *,
        axis: int | str | None = None,
        where: Mask | None = None,
    ) -> Estimates: ...
    def differs(self, other: Estimates | Number) -> Bools: ...
    def to_pandas(self) -> Any: ...
    def to_pint(self, registry: Any = None) -> tuple[Any, Any]: ...
    def __array__(self, dtype: Any = None, copy: bool | None = None) -> npt.NDArray[Any]: ...
    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **keywords: Any) -> Any: ...
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[Estimates]: ...
    def __float__(self) -> float: ...
    def __format__(self, spec: str) -> str: ...
    def __neg__(self) -> Estimates: ...
    def __pos__(self) -> Estimates: ...
    def __abs__(self) -> Estimates: ...
    def __add__(self, other: Estimates | Number) -> Estimates: ...
    def __radd__(self, other: Number) -> Estimates: ...  # type: ignore[misc]
    def __sub__(self, other: Estimates | Number) -> Estimates: ...
    def __rsub__(self, other: Number) -> Estimates: ...  # type: ignore[misc]
    def __mul__(self, other: Estimates | Number) -> Estimates: ...
    def __rmul__(self, other: Number) -> Estimates: ...  # type: ignore[misc]
    def __truediv__(self, other: Estimates | Number) -> Estimates: ...
    def __rtruediv__(self, other: Number) -> Estimates: ...  # type: ignore[misc]
    def __pow__(self, other: Number) -> Estimates: ...
    def __matmul__(self, other: npt.NDArray[Any]) -> Estimates: ...
    def __rmatmul__(self, other: npt.NDArray[Any]) -> Estimates: ...  # type: ignore[misc]
    def __lt__(self, other: Estimates | Number) -> Bools: ...
    def __le__(self, other: Estimates | Number) -> Bools: ...
    def __gt__(self, other: Estimates | Number) -> Bools: ...
    def __ge__(self, other: Estimates | Number) -> Bools: ...
    def __eq__(self, other: object) -> Any: ...
    def __ne__(self, other: object) -> Any: ...

def propagate(
    function: Callable[..., Any], *light: Estimates, unit: str = "", name: str = ""
) -> Estimates: ...
def align(a: Estimates, b: Estimates) -> tuple[Estimates, Estimates]: ...

class DetectorResult(Estimates):
    type: str
    quantity: str
    bins: list[str]
    def __init__(self, seen: dict[str, Any], units: tuple[str, ...], bands: Sequence[str]) -> None: ...
    def to_xarray(self) -> Any: ...

class Sensors:
    name: str
    names: npt.NDArray[np.object_]
    positions: Array
    shape: tuple[int, ...]
    def __init__(
        self,
        own: Mapping[str, Any],
        rows: slice,
        light: Mapping[str, Any],
        organs: Organs,
        is_sum: bool = False,
    ) -> None: ...
    def keys(self) -> list[str]: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def __getitem__(self, quantity: str) -> Estimates: ...
    def to_xarray(self) -> Any: ...

class Organs:
    bands: tuple[str, ...]
    units: tuple[str, ...]
    length_unit: str
    has_ground: bool
    triangle_count: int
    def __init__(self, scene: Any) -> None: ...
    @property
    def ids(self) -> npt.NDArray[np.int64]: ...
    @property
    def areas(self) -> Array: ...
    @property
    def heights(self) -> Array: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def labels(self) -> dict[str, list[str]]: ...
    @property
    def sensor_sets(self) -> list[dict[str, Any]]: ...
    def label(self, key: str) -> npt.NDArray[np.str_]: ...
    def where(self, condition: str | None = None, **labels: object) -> npt.NDArray[np.bool_]: ...
    def without_triangles(self) -> Organs: ...
    def index_of(self, organ: int | str) -> int: ...
    def triangles(self, index: int) -> Array: ...
    def __len__(self) -> int: ...

Which = Union[int, str, Sequence[Union[int, str]], npt.NDArray[Any]]

class SceneOrgans(Organs):
    def __init__(self, scene: Scene) -> None: ...
    def __contains__(self, organ: int | str) -> bool: ...
    def replace(
        self,
        which: Which,
        vertices: npt.ArrayLike,
        faces: npt.ArrayLike | None = None,
        *,
        organ: npt.ArrayLike | None = None,
        material: str | Sequence[str] | npt.NDArray[Any] | None = None,
    ) -> None: ...
    def remove(self, which: Which) -> None: ...
    def transform(
        self,
        which: Which,
        *,
        scale: float = 1,
        rotate: Mapping[str, Any] | None = None,
        translate: npt.ArrayLike | None = None,
    ) -> None: ...
    def set(
        self,
        which: Which,
        *,
        material: str | None = None,
        labels: Mapping[str, object] | None = None,
        name: str | None = None,
        measured: bool | None = None,
    ) -> None: ...

class Light(Mapping[str, Estimates]):
    def __init__(
        self,
        values: Array,
        index: Any,
        organs: Organs,
        *,
        sunlit: Array | None = None,
        rows: Any = None,
        replicates: Any = None,
        origins: Mapping[str, Any] | None = None,
        is_summed: bool = False,
    ) -> None: ...
    @property
    def bands(self) -> tuple[str, ...]: ...
    @property
    def origins(self) -> tuple[str, ...]: ...
    def __getitem__(self, quantity: str) -> Estimates: ...
    def keys(self) -> list[str]: ...  # type: ignore[override]
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...

class GapIndices:
    gap: Estimates
    clumping: Estimates
    sky_transmittance: Estimates
    effective_plant_area_index: Estimates
    plant_area_index: Estimates
    clumping_index: Estimates

class GapFraction:
    gap: Estimates
    rings_deg: Array
    by_position: GapIndices
    all: GapIndices
    closed_bins: int

class SunShade:
    def __getitem__(self, quantity: str) -> Estimates: ...
    def keys(self) -> list[str]: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...
    def to_pandas(self) -> Any: ...

class GroundLight(Light): ...

class Groups(Light):
    groups: list[dict[str, Any]]
    def __init__(
        self,
        core: Any,
        organs: Organs,
        ratio_names: Iterable[str] = (),
        *,
        first: int = 0,
        is_summed: bool = False,
        replicates: Any = None,
        parts: Any = None,
        origins: Mapping[str, Any] | None = None,
    ) -> None: ...
    def keys(self) -> list[str]: ...  # type: ignore[override]
    @property
    def ratios(self) -> dict[str, Estimates]: ...
    @property
    def sun_shade(self) -> SunShade: ...
    @property
    def areas(self) -> Array: ...
    def to_pandas(self) -> Any: ...

class Sums(Light):
    seconds: float
    groups: Groups | None
    sensors: dict[str, Sensors]
    def __init__(
        self,
        values: Array,
        seconds: float,
        organs: Organs,
        groups: Any = None,
        origins: Mapping[str, Any] | None = None,
        sensors: Mapping[str, Any] | None = None,
        sun_shade: Mapping[str, Any] | None = None,
        lights: Any = None,
    ) -> None: ...
    @property
    def sun_shade(self) -> SunShade: ...
    def to_pandas(self) -> Any: ...

class Picture:
    png: bytes
    size: tuple[int, int]
    def __init__(self, png: bytes) -> None: ...
    def save(self, path: str | os.PathLike[str]) -> Path: ...
    @property
    def pixels(self) -> npt.NDArray[np.uint8]: ...
    def __eq__(self, other: object) -> bool: ...

class Page:
    html: str
    height: int
    def __init__(self, html: str, height: int = 640) -> None: ...

def open(path: str | os.PathLike[str]) -> Result | Series | Sweep: ...

class RunInfo:
    method: str
    reason: str
    paths: int
    replicates: int
    rays: int
    stop: str
    fraction_at_target: float
    preparation_seconds: float
    solve_seconds: float
    solve_cpu_seconds: float
    escaped_by_difference: bool
    rounds: list[dict[str, float]]
    audit: dict[str, Any] | None
    sources: list[str]
    def __init__(self, core: Any, sources: Iterable[str]) -> None: ...

class Result(Light):
    organs: Organs
    run: RunInfo
    warnings: list[str]
    def __init__(
        self,
        core: Any,
        organs: Organs,
        warnings: Iterable[str] = (),
        sources: Iterable[str] = (),
        ratio_names: Iterable[str] = (),
        replicates: Any = None,
        written: Any = None,
        identity: str | None = None,
    ) -> None: ...
    @property
    def has_replicates(self) -> bool: ...
    @property
    def ground(self) -> GroundLight | None: ...
    @property
    def ratios(self) -> dict[str, Estimates]: ...
    @property
    def groups(self) -> Groups: ...
    @property
    def budget(self) -> dict[str, Estimates]: ...
    @property
    def canopy(self) -> dict[str, Estimates]: ...
    @property
    def sensors(self) -> dict[str, Sensors]: ...
    @property
    def detectors(self) -> dict[str, DetectorResult]: ...
    @property
    def sun_shade(self) -> SunShade: ...
    def at(self, organs: int | str | Iterable[int | str]) -> Light: ...
    def by(
        self, *labels: str, layers: int = 0, layer_heights: Sequence[float] = ()
    ) -> Groups: ...
    def sum(
        self,
        quantity: str,
        where: Mask | str | None = None,
        *,
        by: str | npt.ArrayLike | None = None,
    ) -> Estimates: ...
    def save(self, path: str | os.PathLike[str], **table: Any) -> Path: ...
    def picture(
        self,
        path: str | os.PathLike[str] | None = None,
        quantity: str = "absorbed_flux_density",
        band: str | None = None,
        **options: Any,
    ) -> Picture: ...
    def report(self, path: str | os.PathLike[str]) -> Path: ...
    def show(self) -> Page | str: ...
    def __copy__(self) -> Result: ...
    def __deepcopy__(self, memo: Any) -> Result: ...
    def __eq__(self, other: object) -> bool: ...
    def to_pandas(self) -> Any: ...
    def to_pyvista(self) -> Any: ...
    def to_xarray(self) -> Any: ...
    @property
    def plot(self) -> Any: ...

class Control:
    sources: str
    sensors: str
    band: str
    lamp_count: int
    factor: Array
    on: Array
    kwh: Array
    is_near_threshold: npt.NDArray[np.bool_]
    daylight: Estimates
    lamps: Estimates
    light: Estimates
    days: dict[str, ControlDay]
    def __init__(self, own: Mapping[str, Any], times: Sequence[str]) -> None: ...
    def to_pandas(self) -> Any: ...

class ControlledLight(Control):
    def __init__(self, own: Mapping[str, Any], times: Sequence[str], series: Series) -> None: ...
    def __getitem__(self, quantity: str) -> Estimates: ...

class ControlDay:
    hours_on: float
    kwh: float
    hours_near_threshold: float
    lamps: Estimates
    light: Estimates
    def __init__(self, own: Mapping[str, Any], unit: str) -> None: ...

class Series:
    organs: Organs
    times: list[dict[str, Any]]
    warnings: list[str]
    sources: list[str]
    stop: str
    computed: int
    completed: int
    time_steps: int
    audit_p_value: float
    rays: int
    seconds: float
    total_seconds: float
    methods: dict[str, int]
    def __init__(
        self,
        core: Any,
        organs: Organs,
        warnings: Iterable[str] = (),
        sources: Iterable[str] = (),
        ratio_names: Iterable[str] = (),
        written: Any = None,
    ) -> None: ...
    @property
    def days(self) -> dict[str, Sums]: ...
    @property
    def total(self) -> Sums: ...
    @property
    def control(self) -> dict[str, Control]: ...
    def controlled(self, sources: str, sensors: str, **keys: Any) -> ControlledLight: ...
    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, index: int) -> Result: ...
    @overload
    def __getitem__(self, index: slice) -> list[Result]: ...
    @overload
    def __getitem__(self, index: str) -> Estimates: ...
    def __iter__(self) -> Iterator[Result]: ...
    def save(self, path: str | os.PathLike[str], **table: Any) -> Path: ...
    def to_pandas(self) -> Any: ...
    def to_xarray(self) -> Any: ...
    @property
    def plot(self) -> Any: ...

ProgressArgument = Union[bool, Callable[[Progress], object], None]
OneSource = Union[Source, Mapping[str, Any]]
SourcesArgument = Union[Source, Mapping[str, Any], Iterable[OneSource], None]

class Sources(MutableSequence[Source]):
    def __init__(self, scene: Scene) -> None: ...
    @property
    def names(self) -> list[str | None]: ...
    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, key: int | str) -> Source: ...
    @overload
    def __getitem__(self, key: slice) -> list[Source]: ...
    @overload
    def __setitem__(self, key: int | str, value: OneSource) -> None: ...
    @overload
    def __setitem__(self, key: slice, value: Iterable[OneSource]) -> None: ...
    def __delitem__(self, key: int | str | slice) -> None: ...
    def insert(self, index: int, value: OneSource) -> None: ...
    def __eq__(self, other: object) -> bool: ...

class _ByBand(MutableMapping[str, float]):
    def __init__(self, material: Material, key: str, values: Mapping[str, float]) -> None: ...
    def __getitem__(self, band: str) -> float: ...
    def __setitem__(self, band: str, value: float) -> None: ...
    def __delitem__(self, band: str) -> None: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...

class Material:
    def __init__(self, scene: Scene, name: str) -> None: ...
    @property
    def name(self) -> str: ...
    def table(self) -> dict[str, Any]: ...
    def set(self, **keys: Any) -> None: ...
    @property
    def reflectance(self) -> _ByBand: ...
    @reflectance.setter
    def reflectance(self, value: Numbers) -> None: ...
    @property
    def transmittance(self) -> _ByBand: ...
    @transmittance.setter
    def transmittance(self, value: Numbers) -> None: ...
    def __eq__(self, other: object) -> bool: ...

class Materials(MutableMapping[str, Material]):
    def __init__(self, scene: Scene) -> None: ...
    def __getitem__(self, name: str) -> Material: ...
    def __setitem__(self, name: str, value: Material | Mapping[str, Any]) -> None: ...
    def __delitem__(self, name: str) -> None: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...

class Part:
    index: int
    count: int
    def __init__(
        self,
        index: int,
        count: int,
        sums: bytes,
        method: Sequence[str],
        document: tuple[Any, ...],
        warnings: Sequence[str],
        written: Any,
    ) -> None: ...

def merge(parts: Iterable[Part]) -> Result: ...

class Ground(_Value):
    material: str
    height: float | None
    x: Interval | None
    y: Interval | None
    z: Interval | None
    name: str | None
    measured: bool | None
    file: str | None
    format: str | None
    transform: Any
    def __init__(
        self,
        material: str,
        *,
        height: float | None = None,
        x: Interval | None = None,
        y: Interval | None = None,
        z: Interval | None = None,
        name: str | None = None,
        measured: bool | None = None,
        file: str | os.PathLike[str] | None = None,
        format: str | None = None,
        transform: Any = None,
    ) -> None: ...

class Cell(_Value):
    x: Interval | None
    y: Interval | None
    z: Interval | None
    file: str | None
    def __init__(
        self,
        x: Interval | None = None,
        y: Interval | None = None,
        z: Interval | None = None,
        *,
        file: str | os.PathLike[str] | None = None,
    ) -> None: ...

class Site(_Value):
    latitude_deg: float
    longitude_deg: float
    elevation_m: float | None
    pressure_hpa: float | None
    temperature_c: float | None
    def __init__(
        self,
        latitude_deg: float,
        longitude_deg: float,
        *,
        elevation_m: float | None = None,
        pressure_hpa: float | None = None,
        temperature_c: float | None = None,
    ) -> None: ...

class Time(_Value):
    def __init__(self, **keys: Any) -> None: ...
    def __getattr__(self, key: str) -> Any: ...

class RunOptions(_Value):
    def __init__(self, **keys: Any) -> None: ...
    def __getattr__(self, key: str) -> Any: ...

def day(date: Date, *, utc_offset_hours: float, **keys: Any) -> Time: ...
def days(start: Date, end: Date, *, utc_offset_hours: float, **keys: Any) -> Time: ...
def times(sequence: Any, **keys: Any) -> Time: ...
def weather(
    path: str | os.PathLike[str],
    *,
    start: Date | None = None,
    end: Date | None = None,
    **keys: Any,
) -> Time: ...

class Sweep(Sequence[Result]):
    points: list[dict[str, Any]]
    def __init__(
        self, points: list[dict[str, Any]], results: list[Result], written: Any = None
    ) -> None: ...
    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, index: int) -> Result: ...
    @overload
    def __getitem__(self, index: slice) -> list[Result]: ...
    @overload
    def __getitem__(self, index: str) -> Estimates: ...
    @property
    def organs(self) -> Organs: ...
    @property
    def budget(self) -> Mapping[str, Estimates]: ...
    @property
    def canopy(self) -> Mapping[str, Estimates]: ...
    @property
    def ground(self) -> Mapping[str, Estimates] | None: ...
    def sum(self, quantity: str, weights: Sequence[float] | None = None) -> Estimates: ...
    def save(self, path: str | os.PathLike[str], **table: Any) -> Path: ...
    def to_pandas(self) -> Any: ...
    def to_xarray(self) -> Any: ...

class Scene:
    def part(
        self,
        index: int,
        count: int,
        sources: SourcesArgument = None,
        *,
        progress: ProgressArgument = None,
        **options: Any,
    ) -> Part: ...
    @property
    def materials(self) -> Materials: ...
    def __init__(
        self,
        bands: str | Sequence[str | Mapping[str, Any]] | Mapping[str, str] = "PAR",
        *,
        irradiance_unit: str | None = None,
        length_unit: str | None = None,
        up: Literal["z", "y"] | None = None,
        north: Sequence[float] | None = None,
        site: Site | None = None,
        title: str | None = None,
    ) -> None: ...
    def __copy__(self) -> Scene: ...
    def __deepcopy__(self, memo: Any) -> Scene: ...
    def __eq__(self, other: object) -> bool: ...
    def gap_fraction(
        self,
        positions: npt.ArrayLike,
        rings_deg: Sequence[float] = ...,
        azimuths: int = 8,
        where: str = "",
        rays: int = 4096,
        replicates: int = 8,
        seed: int = 1,
        threads: int = 0,
    ) -> GapFraction: ...
    def picture(
        self, path: str | os.PathLike[str] | None = None, **options: Any
    ) -> Picture: ...
    def to_trimesh(self) -> Any: ...
    def to_pyvista(self) -> Any: ...
    def show(self, **options: Any) -> Picture: ...
    def add_material(
        self,
        name: str,
        reflectance: Numbers | None = None,
        transmittance: Numbers | None = None,
        *,
        upper: Mapping[str, Any] | None = None,
        lower: Mapping[str, Any] | None = None,
        **keys: Any,
    ) -> Scene: ...
    def add_mesh(
        self,
        vertices: npt.ArrayLike,
        faces: npt.ArrayLike | None = None,
        *,
        material: str | Mapping[int, str] | Sequence[str] | npt.NDArray[Any],
        organ: npt.ArrayLike | None = None,
        name: PerOrgan | None = None,
        labels: Mapping[str, PerOrgan] | None = None,
        measured: bool = True,
        field_of_view_deg: float = 90.0,
    ) -> Scene: ...
    def add_trimesh(self, mesh: Any, *, material: str, **keys: Any) -> Scene: ...
    def add_pyvista(self, mesh: Any, *, material: str, **keys: Any) -> Scene: ...
    def replace(
        self,
        name: str,
        vertices: npt.ArrayLike,
        faces: npt.ArrayLike | None = None,
        *,
        material: str | Mapping[int, str] | Sequence[str] | npt.NDArray[Any],
        organ: npt.ArrayLike | None = None,
        labels: Mapping[str, PerOrgan] | None = None,
        measured: bool = True,
        field_of_view_deg: float = 90.0,
    ) -> Scene: ...
    def remove(self, name: str) -> Scene: ...
    def add_organ(self, shape: str, *, material: str, **keys: Any) -> Scene: ...
    def add_file(self, file: str | os.PathLike[str], **keys: Any) -> Scene: ...
    def add_sensors(self, points: Any = None, name: str = "sensors", **keys: Any) -> Scene: ...
    def add_control(self, sources: str, sensors: str, **keys: Any) -> Scene: ...
    def add_detector(self, type: str, **keys: Any) -> Scene: ...
    ground: Ground | None
    cell: Cell | None
    site: Site | None
    time: Time | None
    options: RunOptions | None
    @property
    def sources(self) -> Sources: ...
    @sources.setter
    def sources(self, sources: SourcesArgument) -> None: ...
    def build(self) -> Organs: ...
    @property
    def organs(self) -> SceneOrgans: ...
    @property
    def warnings(self) -> list[str]: ...
    def run(
        self,
        sources: SourcesArgument = None,
        *,
        progress: ProgressArgument = None,
        keep: Literal["auto", "replicates", "estimates"] = "auto",
        sampler: str = ...,
        method: str = ...,
        paths: int = ...,
        replicates: int = ...,
        seed: int = ...,
        threads: int = ...,
        target_error: float = ...,
        target_fraction: float = ...,
        target: str = ...,
        target_quantity: str = ...,
        target_bands: Sequence[str] = ...,
        max_seconds: float = ...,
        max_paths: int = ...,
        path_allocation: str = ...,
        time_method: str = ...,
        ratios: Sequence[str] = ...,
        groups: Sequence[str] = ...,
        origins: Sequence[str] = ...,
        sun_shade: str = ...,
        layers: int = ...,
        layer_heights: Sequence[float] = ...,
        direct_light: str = ...,
        audit: float = ...,
        max_depth: int = ...,
        roulette_threshold: float = ...,
        start_area: str = ...,
        accelerator: str = ...,
        tally_memory_mb: float = ...,
    ) -> Result: ...
    def series(
        self,
        time: Time | None = None,
        sources: SourcesArgument = None,
        *,
        progress: ProgressArgument = None,
        keep: Literal["auto", "replicates", "estimates", "sums"] = "auto",
        sampler: str = ...,
        method: str = ...,
        paths: int = ...,
        replicates: int = ...,
        seed: int = ...,
        threads: int = ...,
        target_error: float = ...,
        target_fraction: float = ...,
        target: str = ...,
        target_quantity: str = ...,
        target_bands: Sequence[str] = ...,
        max_seconds: float = ...,
        max_paths: int = ...,
        path_allocation: str = ...,
        time_method: str = ...,
        ratios: Sequence[str] = ...,
        groups: Sequence[str] = ...,
        origins: Sequence[str] = ...,
        sun_shade: str = ...,
        layers: int = ...,
        layer_heights: Sequence[float] = ...,
        direct_light: str = ...,
        audit: float = ...,
        max_depth: int = ...,
        roulette_threshold: float = ...,
        start_area: str = ...,
        accelerator: str = ...,
        tally_memory_mb: float = ...,
    ) -> Series: ...
    def sweep(
        self,
        values: Mapping[str, Sequence[Any]],
        sources: SourcesArgument = None,
        *,
        combine: Literal["product", "zip"] = "product",
        progress: ProgressArgument = None,
        keep: Literal["auto", "replicates", "estimates"] = "auto",
        sampler: str = ...,
        method: str = ...,
        paths: int = ...,
        replicates: int = ...,
        seed: int = ...,
        threads: int = ...,
        target_error: float = ...,
        target_fraction: float = ...,
        target: str = ...,
        target_quantity: str = ...,
        target_bands: Sequence[str] = ...,
        max_seconds: float = ...,
        max_paths: int = ...,
        path_allocation: str = ...,
        time_method: str = ...,
        ratios: Sequence[str] = ...,
        groups: Sequence[str] = ...,
        origins: Sequence[str] = ...,
        sun_shade: str = ...,
        layers: int = ...,
        layer_heights: Sequence[float] = ...,
        direct_light: str = ...,
        audit: float = ...,
        max_depth: int = ...,
        roulette_threshold: float = ...,
        start_area: str = ...,
        accelerator: str = ...,
        tally_memory_mb: float = ...,
    ) -> Sweep: ...

class GrowthStep:
    step: int
    string: str
    image: str | None
    light: Any
    def __init__(self, core: Any, light: Any) -> None: ...
    @property
    def organs(self) -> Organs | None: ...
    @property
    def scene(self) -> Organs | None: ...

def grow(
    model: str | os.PathLike[str],
    view: str | os.PathLike[str] | None = None,
    *,
    light: Scene | str | os.PathLike[str] | None = None,
    sources: SourcesArgument = None,
    materials: Mapping[str, str] | None = None,
    material: str | None = None,
    quantity: str = "absorbed_flux_density",
    steps: int | None = None,
    image: bool = False,
    progress: ProgressArgument = None,
    sampler: str = ...,
    method: str = ...,
    paths: int = ...,
    replicates: int = ...,
    seed: int = ...,
    threads: int = ...,
    target_error: float = ...,
    target_fraction: float = ...,
    target: str = ...,
    target_quantity: str = ...,
    target_bands: Sequence[str] = ...,
    max_seconds: float = ...,
    max_paths: int = ...,
    path_allocation: str = ...,
    time_method: str = ...,
    ratios: Sequence[str] = ...,
    groups: Sequence[str] = ...,
    origins: Sequence[str] = ...,
    sun_shade: str = ...,
    layers: int = ...,
    layer_heights: Sequence[float] = ...,
    direct_light: str = ...,
    audit: float = ...,
    max_depth: int = ...,
    roulette_threshold: float = ...,
    start_area: str = ...,
    accelerator: str = ...,
    tally_memory_mb: float = ...,
) -> Iterator[GrowthStep]: ...
def load(path: str | os.PathLike[str]) -> Scene: ...
def options() -> list[dict[str, Any]]: ...
def quantities() -> dict[str, str]: ...
def shapes() -> list[str]: ...
