// Elements of the page. Texts of results are never markup.

const kSvg = "http://www.w3.org/2000/svg";

export const byId = (id) => document.getElementById(id);

function withAttributes(element, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) {
      element.addEventListener(key.slice(2), value);
    } else if (value !== undefined && value !== null && value !== false) {
      element.setAttribute(key, value === true ? "" : value);
    }
  }
  element.append(...children.flat(3).filter((child) => child !== null && child !== undefined && child !== "" && child !== false));
  return element;
}

/** An element of HTML. @param attributes  keys that begin with "on" are listeners  @param children  nodes and texts */
export function make(name, attributes = {}, ...children) {
  return withAttributes(document.createElement(name), attributes, children);
}

/** An element of SVG. */
export function svg(name, attributes = {}, ...children) {
  return withAttributes(document.createElementNS(kSvg, name), attributes, children);
}
