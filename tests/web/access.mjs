// Obstacles for people that need contrast, or have no mouse. The functions run in the page.

/** The texts whose contrast to their background is below 4.5 (WCAG 2, level AA), of which there must be none. */
export const faintTexts = () => {
  const numbers = (color) => color.match(/[\d.]+/g).map(Number);
  const luminance = (color) => numbers(color).slice(0, 3).reduce((sum, part, k) => {
    const share = part / 255;
    return sum + [0.2126, 0.7152, 0.0722][k] * (share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4);
  }, 0);
  const behind = (element) => {
    const color = getComputedStyle(element).backgroundColor;
    return (numbers(color)[3] ?? 1) > 0 || !element.parentElement ? color : behind(element.parentElement);
  };
  const own = (element) => [...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.textContent.trim());
  return [...document.body.querySelectorAll("*")].filter((element) =>
    own(element) && element.checkVisibility() && !element.closest("noscript, script, option")).flatMap((element) => {
    const style = getComputedStyle(element);
    if (element.closest(".badge, .letter")) { return []; } // tested with their own colours
    const [one, other] = [luminance(element.closest("svg") ? style.fill : style.color), luminance(behind(element))];
    const contrast = (Math.max(one, other) + 0.05) / (Math.min(one, other) + 0.05);
    return contrast < 4.5 ? [`${contrast.toFixed(2)}: ${element.outerHTML.slice(0, 120)}`] : [];
  });
};

/** Controls that keys do not reach: neither by Tab, nor by arrows in a group of which Tab reaches one. */
export const unreachable = () => {
  const kControls = "button, select, input, summary, a[href], [role=button], [role=tab], [role=radio], [role=slider], [role=application]";
  const kGroups = "[role=radiogroup], [role=tablist], [role=menu], .plot, #table tbody";
  const isSeen = (element) => element.checkVisibility({ visibilityProperty: true }) && element.getClientRects().length > 0;
  return [...document.querySelectorAll(kControls)].filter((element) => isSeen(element) && !element.disabled).filter((element) => {
    const group = element.closest(kGroups);
    const isEntry = group && [...group.querySelectorAll(kControls)].some((one) => one.tabIndex >= 0);
    return element.tabIndex < 0 && !isEntry;
  }).map((element) => element.outerHTML.slice(0, 120));
};

/** Controls without a name. */
export const nameless = () => [...document.querySelectorAll("button, select, input, [role=button], [role=tab], [role=radio], [role=slider], [role=application], canvas:not([aria-hidden])")]
  .filter((element) => element.checkVisibility()).filter((element) => {
    const labels = [...(element.labels ?? [])].map(({ textContent }) => textContent).join("");
    return !(element.getAttribute("aria-label") || element.textContent.trim() || labels.trim() || element.title);
  }).map((element) => element.outerHTML.slice(0, 120));

/** Elements that move by themselves or by transitions. */
export const moving = () => [...document.querySelectorAll("body *")].filter((element) => {
  const { transitionDuration, animationName, animationDuration } = getComputedStyle(element);
  const lasts = (text) => text.split(",").some((one) => parseFloat(one) > 0.01);
  return element.checkVisibility() && (lasts(transitionDuration) || (animationName !== "none" && lasts(animationDuration)));
}).map((element) => element.outerHTML.slice(0, 120));
