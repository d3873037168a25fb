from typing import Any, ClassVar

Light = tuple[float, tuple[float, float, float]]
Values = dict[str, Any]

class CaribuTriangleSet:
    def __init__(self, scene: dict[Any, Any]) -> None: ...
    def keys(self) -> Any: ...
    def values(self) -> Any: ...
    def items(self) -> Any: ...
    def __len__(self) -> int: ...
    def __getitem__(self, pid: Any) -> list[Any]: ...

class CaribuScene:
    default_material: ClassVar[tuple[float, ...]]
    default_soil_reflectance: ClassVar[float]
    default_light: ClassVar[Light]
    default_band: ClassVar[str]
    units: ClassVar[dict[str, float]]
    scene: CaribuTriangleSet | None
    light: list[Light]
    lightfile: str | None
    pattern: tuple[float, ...] | None
    material: dict[str, dict[Any, tuple[float, ...]]]
    soil_reflectance: dict[str, float]
    soil: list[Any] | None
    soil_label: str | int
    soil_raw: Values | None
    soil_aggregated: Values | None
    conv_unit: float
    def __init__(
        self,
        scene: Any = None,
        light: Any = None,
        pattern: Any = None,
        opt: Any = None,
        soil_reflectance: dict[str, float] | None = None,
        soil_mesh: int | None = None,
        z_soil: float | None = None,
        scene_unit: str = "m",
        debug: bool = False,
        filecache: bool = True,
    ) -> None: ...
    def setLight(self, light: Any) -> None: ...
    def bbox(self) -> tuple[tuple[float, ...], tuple[float, ...]]: ...
    def triangle_areas(self, convert: bool = True) -> Any: ...
    def auto_screen(self, screen_resolution: float) -> int: ...
    def getIncidentEnergy(self) -> tuple[float, float, float | None]: ...
    def getSoilEnergy(self) -> tuple[float, float]: ...
    def as_primitive(
        self,
    ) -> tuple[list[Any], list[Any], dict[str, list[Any]], list[str], dict[str, float]]: ...
    def runPeriodise(self) -> CaribuScene: ...
    def run(
        self,
        direct: bool = True,
        infinite: bool = False,
        d_sphere: float | None = None,
        layers: int | None = None,
        height: float | None = None,
        screen_size: int | None = None,
        screen_resolution: float | None = None,
        sensors: dict[Any, Any] | None = None,
        split_face: bool = False,
        simplify: bool = False,
        *,
        precision: float | None = None,
        **options: Any,
    ) -> tuple[Values, Values]: ...
    def plot(
        self,
        a_property: dict[Any, Any] | None = None,
        minval: float | None = None,
        maxval: float | None = None,
        gamma: float | None = None,
        display: bool = True,
    ) -> tuple[Any, list[float] | None]: ...
