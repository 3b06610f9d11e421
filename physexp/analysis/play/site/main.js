var c0=(async function(i={}){var e,t=i,n=typeof window=="object",s=typeof WorkerGlobalScope<"u",o=typeof process=="object"&&process.versions?.node&&process.type!="renderer",c=!n&&!o&&!s;if(o){let{createRequire:r}=await import("module");var h=r(import.meta.url)}var d=[],f="./this.program",p=(r,a)=>{throw a},_=import.meta.url,g="";function S(r){return t.locateFile?t.locateFile(r,g):g+r}var w,R;if(o){if(!(typeof process=="object"&&process.versions?.node&&process.type!="renderer"))throw new Error("not compiled for this environment (did you build to HTML and try to run it not on the web, or set ENVIRONMENT to something - like node - and run it someplace else - like on the web?)");var x=process.versions.node,y=x.split(".").slice(0,3);if(y=y[0]*1e4+y[1]*100+y[2].split("-")[0]*1,y<16e4)throw new Error("This emscripten-generated code requires node v16.0.0 (detected v"+x+")");var P=h("fs");_.startsWith("file:")&&(g=h("path").dirname(h("url").fileURLToPath(_))+"/"),R=a=>{a=ne(a)?new URL(a):a;var l=P.readFileSync(a);return G(Buffer.isBuffer(l)),l},w=async(a,l=!0)=>{a=ne(a)?new URL(a):a;var u=P.readFileSync(a,l?void 0:"utf8");return G(l?Buffer.isBuffer(u):typeof u=="string"),u},process.argv.length>1&&(f=process.argv[1].replace(/\\/g,"/")),d=process.argv.slice(2),p=(a,l)=>{throw process.exitCode=a,l}}else if(c){if(typeof process=="object"&&process.versions?.node&&process.type!="renderer"||typeof window=="object"||typeof WorkerGlobalScope<"u")throw new Error("not compiled for this environment (did you build to HTML and try to run it not on the web, or set ENVIRONMENT to something - like node - and run it someplace else - like on the web?)")}else if(n||s){try{g=new URL(".",_).href}catch{}if(!(typeof window=="object"||typeof WorkerGlobalScope<"u"))throw new Error("not compiled for this environment (did you build to HTML and try to run it not on the web, or set ENVIRONMENT to something - like node - and run it someplace else - like on the web?)");s&&(R=r=>{var a=new XMLHttpRequest;return a.open("GET",r,!1),a.responseType="arraybuffer",a.send(null),new Uint8Array(a.response)}),w=async r=>{if(ne(r))return new Promise((l,u)=>{var m=new XMLHttpRequest;m.open("GET",r,!0),m.responseType="arraybuffer",m.onload=()=>{if(m.status==200||m.status==0&&m.response){l(m.response);return}u(m.status)},m.onerror=u,m.send(null)});var a=await fetch(r,{credentials:"same-origin"});if(a.ok)return a.arrayBuffer();throw new Error(a.status+" : "+a.url)}}else throw new Error("environment detection error");var U=console.log.bind(console),I=console.error.bind(console),O="IDBFS is no longer included by default; build with -lidbfs.js",N="PROXYFS is no longer included by default; build with -lproxyfs.js",b="WORKERFS is no longer included by default; build with -lworkerfs.js",L="FETCHFS is no longer included by default; build with -lfetchfs.js",q="ICASEFS is no longer included by default; build with -licasefs.js",k="JSFILEFS is no longer included by default; build with -ljsfilefs.js",Y="OPFS is no longer included by default; build with -lopfs.js",J="NODEFS is no longer included by default; build with -lnodefs.js";G(!c,"shell environment detected but not enabled at build time.  Add `shell` to `-sENVIRONMENT` to enable.");var ee;typeof WebAssembly!="object"&&I("no native wasm support detected");var z=!1,ie;function G(r,a){r||pe("Assertion failed"+(a?": "+a:""))}var ne=r=>r.startsWith("file://");function Se(){var r=Cl();G((r&3)==0),r==0&&(r+=4),qe[r>>2]=34821223,qe[r+4>>2]=2310721022,qe[0]=1668509029}function re(){if(!z){var r=Cl();r==0&&(r+=4);var a=qe[r>>2],l=qe[r+4>>2];(a!=34821223||l!=2310721022)&&pe(`Stack overflow! Stack cookie has been overwritten at ${Ot(r)}, expected hex dwords 0x89BACDFE and 0x2135467, but received ${Ot(l)} ${Ot(a)}`),qe[0]!=1668509029&&pe("Runtime error: The application has corrupted its heap memory area (address zero)!")}}class H extends Error{}class me extends H{}class Xe extends H{constructor(a){super(a),this.excPtr=a;let l=Ch(a);this.name=l[0],this.message=l[1]}}var nt=!0;function ue(...r){!nt&&typeof nt<"u"||console.warn(...r)}(()=>{var r=new Int16Array(1),a=new Int8Array(r.buffer);if(r[0]=25459,a[0]!==115||a[1]!==99)throw"Runtime error: expected the system to be little-endian! (Run with -sSUPPORT_BIG_ENDIAN to bypass)"})();function Fe(r){Object.getOwnPropertyDescriptor(t,r)||Object.defineProperty(t,r,{configurable:!0,set(){pe(`Attempt to set \`Module.${r}\` after it has already been processed.  This can happen, for example, when code is injected via '--post-js' rather than '--pre-js'`)}})}function Pe(r){return()=>G(!1,`call to '${r}' via reference taken before Wasm module initialization`)}function je(r){Object.getOwnPropertyDescriptor(t,r)&&pe(`\`Module.${r}\` was supplied but \`${r}\` not included in INCOMING_MODULE_JS_API`)}function Ue(r){return r==="FS_createPath"||r==="FS_createDataFile"||r==="FS_createPreloadedFile"||r==="FS_unlink"||r==="addRunDependency"||r==="FS_createLazyFile"||r==="FS_createDevice"||r==="removeRunDependency"}function rt(r,a){typeof globalThis<"u"&&!Object.getOwnPropertyDescriptor(globalThis,r)&&Object.defineProperty(globalThis,r,{configurable:!0,get(){a()}})}function Gt(r,a){rt(r,()=>{Wn(`\`${r}\` is not longer defined by emscripten. ${a}`)})}Gt("buffer","Please use HEAP8.buffer or wasmMemory.buffer"),Gt("asm","Please use wasmExports instead");function et(r){rt(r,()=>{var a=`\`${r}\` is a library symbol and not included by default; add it to your library.js __deps or to DEFAULT_LIBRARY_FUNCS_TO_INCLUDE on the command line`,l=r;l.startsWith("_")||(l="$"+r),a+=` (e.g. -sDEFAULT_LIBRARY_FUNCS_TO_INCLUDE='${l}')`,Ue(r)&&(a+=". Alternatively, forcing filesystem support (-sFORCE_FILESYSTEM) can export this for you"),Wn(a)}),wt(r)}function wt(r){Object.getOwnPropertyDescriptor(t,r)||Object.defineProperty(t,r,{configurable:!0,get(){var a=`'${r}' was not exported. add it to EXPORTED_RUNTIME_METHODS (see the Emscripten FAQ)`;Ue(r)&&(a+=". Alternatively, forcing filesystem support (-sFORCE_FILESYSTEM) can export this for you"),pe(a)}})}var Tt,dt,Vt,ht,Rt,St,Qt,Le,qe,an,en,W,fn,At=!1;function Nt(){var r=Vt.buffer;ht=new Int8Array(r),St=new Int16Array(r),Rt=new Uint8Array(r),Qt=new Uint16Array(r),Le=new Int32Array(r),qe=new Uint32Array(r),an=new Float32Array(r),en=new Float64Array(r),W=new BigInt64Array(r),fn=new BigUint64Array(r)}G(typeof Int32Array<"u"&&typeof Float64Array<"u"&&Int32Array.prototype.subarray!=null&&Int32Array.prototype.set!=null,"JS engine does not provide full typed array support");function De(){if(t.preRun)for(typeof t.preRun=="function"&&(t.preRun=[t.preRun]);t.preRun.length;)lt(t.preRun.shift());Fe("preRun"),$e(Ye)}function Xt(){G(!At),At=!0,re(),!t.noFSInit&&!M.initialized&&M.init(),st.init(),qi.__wasm_call_ctors(),M.ignorePermissions=!1}function Je(){if(re(),t.postRun)for(typeof t.postRun=="function"&&(t.postRun=[t.postRun]);t.postRun.length;)we(t.postRun.shift());Fe("postRun"),$e(ot)}var Ze=0,D=null,T={},j=null;function ve(r){Ze++,t.monitorRunDependencies?.(Ze),r?(G(!T[r]),T[r]=1,j===null&&typeof setInterval<"u"&&(j=setInterval(()=>{if(z){clearInterval(j),j=null;return}var a=!1;for(var l in T)a||(a=!0,I("still waiting on run dependencies:")),I(`dependency: ${l}`);a&&I("(end of list)")},1e4))):I("warning: run dependency added without ID")}function de(r){if(Ze--,t.monitorRunDependencies?.(Ze),r?(G(T[r]),delete T[r]):I("warning: run dependency removed without ID"),Ze==0&&(j!==null&&(clearInterval(j),j=null),D)){var a=D;D=null,a()}}function pe(r){t.onAbort?.(r),r="Aborted("+r+")",I(r),z=!0;var a=new WebAssembly.RuntimeError(r);throw dt?.(a),a}function Me(r,a){return(...l)=>{G(At,`native function \`${r}\` called before runtime initialization`);var u=qi[r];return G(u,`exported native function \`${r}\` not found`),G(l.length<=a,`native function \`${r}\` called with ${l.length} args but expects ${a}`),u(...l)}}var ae;function le(){return t.locateFile?S("mujoco.wasm"):new URL("mujoco.wasm",import.meta.url).href}function Ce(r){if(r==ae&&ee)return new Uint8Array(ee);if(R)return R(r);throw"both async and sync fetching of the wasm failed"}async function B(r){if(!ee)try{var a=await w(r);return new Uint8Array(a)}catch{}return Ce(r)}async function he(r,a){try{var l=await B(r),u=await WebAssembly.instantiate(l,a);return u}catch(m){I(`failed to asynchronously prepare wasm: ${m}`),ne(ae)&&I(`warning: Loading from a file URI (${ae}) is not supported in most browsers. See https://emscripten.org/docs/getting_started/FAQ.html#how-do-i-run-a-local-webserver-for-testing-why-does-my-program-stall-in-downloading-or-preparing`),pe(m)}}async function se(r,a,l){if(!r&&typeof WebAssembly.instantiateStreaming=="function"&&!ne(a)&&!o)try{var u=fetch(a,{credentials:"same-origin"}),m=await WebAssembly.instantiateStreaming(u,l);return m}catch(v){I(`wasm streaming compile failed: ${v}`),I("falling back to ArrayBuffer instantiation")}return he(a,l)}function Re(){return{env:zh,wasi_snapshot_preview1:zh}}async function Ee(){function r(E,A){return qi=E.exports,Vt=qi.memory,G(Vt,"memory not found in wasm exports"),Nt(),na=qi.__indirect_function_table,G(na,"table not found in wasm exports"),um(qi),de("wasm-instantiate"),qi}ve("wasm-instantiate");var a=t;function l(E){return G(t===a,"the Module object should not be replaced during async compilation - perhaps the order of HTML elements is wrong?"),a=null,r(E.instance)}var u=Re();if(t.instantiateWasm)return new Promise((E,A)=>{try{t.instantiateWasm(u,(F,X)=>{E(r(F,X))})}catch(F){I(`Module.instantiateWasm callback failed with error: ${F}`),A(F)}});ae??=le();var m=await se(ee,ae,u),v=l(m);return v}class Ae{name="ExitStatus";constructor(a){this.message=`Program terminated with exit(${a})`,this.status=a}}var $e=r=>{for(;r.length>0;)r.shift()(t)},ot=[],we=r=>ot.push(r),Ye=[],lt=r=>Ye.push(r);function Oe(r,a="i8"){switch(a.endsWith("*")&&(a="*"),a){case"i1":return ht[r];case"i8":return ht[r];case"i16":return St[r>>1];case"i32":return Le[r>>2];case"i64":return W[r>>3];case"float":return an[r>>2];case"double":return en[r>>3];case"*":return qe[r>>2];default:pe(`invalid type for getValue: ${a}`)}}var Et=!0,Ot=r=>(G(typeof r=="number"),r>>>=0,"0x"+r.toString(16).padStart(8,"0"));function li(r,a,l="i8"){switch(l.endsWith("*")&&(l="*"),l){case"i1":ht[r]=a;break;case"i8":ht[r]=a;break;case"i16":St[r>>1]=a;break;case"i32":Le[r>>2]=a;break;case"i64":W[r>>3]=BigInt(a);break;case"float":an[r>>2]=a;break;case"double":en[r>>3]=a;break;case"*":qe[r>>2]=a;break;default:pe(`invalid type for setValue: ${l}`)}}var ye=r=>Fh(r),ge=()=>Uh(),Wn=r=>{Wn.shown||={},Wn.shown[r]||(Wn.shown[r]=1,o&&(r="warning: "+r),I(r))},Yr=typeof TextDecoder<"u"?new TextDecoder:void 0,ci=(r,a=0,l=NaN)=>{for(var u=a+l,m=a;r[m]&&!(m>=u);)++m;if(m-a>16&&r.buffer&&Yr)return Yr.decode(r.subarray(a,m));for(var v="";a<m;){var E=r[a++];if(!(E&128)){v+=String.fromCharCode(E);continue}var A=r[a++]&63;if((E&224)==192){v+=String.fromCharCode((E&31)<<6|A);continue}var F=r[a++]&63;if((E&240)==224?E=(E&15)<<12|A<<6|F:((E&248)!=240&&Wn("Invalid UTF-8 leading byte "+Ot(E)+" encountered when deserializing a UTF-8 string in wasm memory to a JS string!"),E=(E&7)<<18|A<<12|F<<6|r[a++]&63),E<65536)v+=String.fromCharCode(E);else{var X=E-65536;v+=String.fromCharCode(55296|X>>10,56320|X&1023)}}return v},on=(r,a)=>(G(typeof r=="number",`UTF8ToString expects a number (got ${typeof r})`),r?ci(Rt,r,a):""),jr=(r,a,l,u)=>pe(`Assertion failed: ${on(r)}, at: `+[a?on(a):"unknown filename",l,u?on(u):"unknown function"]),An=[],zi=0,cr=r=>{var a=new hr(r);return a.get_caught()||(a.set_caught(!0),zi--),a.set_rethrown(!1),An.push(a),ca(r),kh(r)},Xs=()=>{if(!An.length)return 0;var r=An[An.length-1];return ca(r.excPtr),r.excPtr},Cn=0,Gi=()=>{xe(0,0),G(An.length>0);var r=An.pop();Rl(r.excPtr),Cn=0};class hr{constructor(a){this.excPtr=a,this.ptr=a-24}set_type(a){qe[this.ptr+4>>2]=a}get_type(){return qe[this.ptr+4>>2]}set_destructor(a){qe[this.ptr+8>>2]=a}get_destructor(){return qe[this.ptr+8>>2]}set_caught(a){a=a?1:0,ht[this.ptr+12]=a}get_caught(){return ht[this.ptr+12]!=0}set_rethrown(a){a=a?1:0,ht[this.ptr+13]=a}get_rethrown(){return ht[this.ptr+13]!=0}init(a,l){this.set_adjusted_ptr(0),this.set_type(a),this.set_destructor(l)}set_adjusted_ptr(a){qe[this.ptr+16>>2]=a}get_adjusted_ptr(){return qe[this.ptr+16>>2]}}var Vi=r=>Lh(r),ur=r=>{var a=Cn?.excPtr;if(!a)return Vi(0),0;var l=new hr(a);l.set_adjusted_ptr(a);var u=l.get_type();if(!u)return Vi(0),a;for(var m of r){if(m===0||m===u)break;var v=l.ptr+16;if(Bh(m,u,v))return Vi(m),a}return Vi(u),a},fl=()=>ur([]),pl=r=>ur([r]),ml=(r,a)=>ur([r,a]),Jr=()=>{var r=An.pop();r||pe("no exception to throw");var a=r.excPtr;throw r.get_rethrown()||(An.push(r),r.set_rethrown(!0),r.set_caught(!1),zi++),Cn=new Xe(a),Cn},C=r=>{if(r){var a=new hr(r);An.push(a),a.set_rethrown(!0),Jr()}},V=(r,a,l)=>{var u=new hr(r);throw u.init(a,l),Cn=new Xe(r),zi++,Cn},te=()=>zi,Z=r=>{throw Cn||(Cn=new Xe(r)),Cn},$={isAbs:r=>r.charAt(0)==="/",splitPath:r=>{var a=/^(\/?|)([\s\S]*?)((?:\.{1,2}|[^\/]+?|)(\.[^.\/]*|))(?:[\/]*)$/;return a.exec(r).slice(1)},normalizeArray:(r,a)=>{for(var l=0,u=r.length-1;u>=0;u--){var m=r[u];m==="."?r.splice(u,1):m===".."?(r.splice(u,1),l++):l&&(r.splice(u,1),l--)}if(a)for(;l;l--)r.unshift("..");return r},normalize:r=>{var a=$.isAbs(r),l=r.slice(-1)==="/";return r=$.normalizeArray(r.split("/").filter(u=>!!u),!a).join("/"),!r&&!a&&(r="."),r&&l&&(r+="/"),(a?"/":"")+r},dirname:r=>{var a=$.splitPath(r),l=a[0],u=a[1];return!l&&!u?".":(u&&(u=u.slice(0,-1)),l+u)},basename:r=>r&&r.match(/([^\/]+|\/)\/*$/)[1],join:(...r)=>$.normalize(r.join("/")),join2:(r,a)=>$.normalize(r+"/"+a)},Ie=()=>{if(o){var r=h("crypto");return a=>r.randomFillSync(a)}return a=>crypto.getRandomValues(a)},Ge=r=>{(Ge=Ie())(r)},Te={resolve:(...r)=>{for(var a="",l=!1,u=r.length-1;u>=-1&&!l;u--){var m=u>=0?r[u]:M.cwd();if(typeof m!="string")throw new TypeError("Arguments to path.resolve must be strings");if(!m)return"";a=m+"/"+a,l=$.isAbs(m)}return a=$.normalizeArray(a.split("/").filter(v=>!!v),!l).join("/"),(l?"/":"")+a||"."},relative:(r,a)=>{r=Te.resolve(r).slice(1),a=Te.resolve(a).slice(1);function l(X){for(var K=0;K<X.length&&X[K]==="";K++);for(var oe=X.length-1;oe>=0&&X[oe]==="";oe--);return K>oe?[]:X.slice(K,oe-K+1)}for(var u=l(r.split("/")),m=l(a.split("/")),v=Math.min(u.length,m.length),E=v,A=0;A<v;A++)if(u[A]!==m[A]){E=A;break}for(var F=[],A=E;A<u.length;A++)F.push("..");return F=F.concat(m.slice(E)),F.join("/")}},Ne=[],Ve=r=>{for(var a=0,l=0;l<r.length;++l){var u=r.charCodeAt(l);u<=127?a++:u<=2047?a+=2:u>=55296&&u<=57343?(a+=4,++l):a+=3}return a},it=(r,a,l,u)=>{if(G(typeof r=="string",`stringToUTF8Array expects a string (got ${typeof r})`),!(u>0))return 0;for(var m=l,v=l+u-1,E=0;E<r.length;++E){var A=r.codePointAt(E);if(A<=127){if(l>=v)break;a[l++]=A}else if(A<=2047){if(l+1>=v)break;a[l++]=192|A>>6,a[l++]=128|A&63}else if(A<=65535){if(l+2>=v)break;a[l++]=224|A>>12,a[l++]=128|A>>6&63,a[l++]=128|A&63}else{if(l+3>=v)break;A>1114111&&Wn("Invalid Unicode code point "+Ot(A)+" encountered when serializing a JS string to a UTF-8 string in wasm memory! (Valid unicode code points should be in range 0-0x10FFFF)."),a[l++]=240|A>>18,a[l++]=128|A>>12&63,a[l++]=128|A>>6&63,a[l++]=128|A&63,E++}}return a[l]=0,l-m},ft=(r,a,l)=>{var u=l>0?l:Ve(r)+1,m=new Array(u),v=it(r,m,0,m.length);return a&&(m.length=v),m},He=()=>{if(!Ne.length){var r=null;if(o){var a=256,l=Buffer.alloc(a),u=0,m=process.stdin.fd;try{u=P.readSync(m,l,0,a)}catch(v){if(v.toString().includes("EOF"))u=0;else throw v}u>0&&(r=l.slice(0,u).toString("utf-8"))}else typeof window<"u"&&typeof window.prompt=="function"&&(r=window.prompt("Input: "),r!==null&&(r+=`
`));if(!r)return null;Ne=ft(r,!0)}return Ne.shift()},st={ttys:[],init(){},shutdown(){},register(r,a){st.ttys[r]={input:[],output:[],ops:a},M.registerDevice(r,st.stream_ops)},stream_ops:{open(r){var a=st.ttys[r.node.rdev];if(!a)throw new M.ErrnoError(43);r.tty=a,r.seekable=!1},close(r){r.tty.ops.fsync(r.tty)},fsync(r){r.tty.ops.fsync(r.tty)},read(r,a,l,u,m){if(!r.tty||!r.tty.ops.get_char)throw new M.ErrnoError(60);for(var v=0,E=0;E<u;E++){var A;try{A=r.tty.ops.get_char(r.tty)}catch{throw new M.ErrnoError(29)}if(A===void 0&&v===0)throw new M.ErrnoError(6);if(A==null)break;v++,a[l+E]=A}return v&&(r.node.atime=Date.now()),v},write(r,a,l,u,m){if(!r.tty||!r.tty.ops.put_char)throw new M.ErrnoError(60);try{for(var v=0;v<u;v++)r.tty.ops.put_char(r.tty,a[l+v])}catch{throw new M.ErrnoError(29)}return u&&(r.node.mtime=r.node.ctime=Date.now()),v}},default_tty_ops:{get_char(r){return He()},put_char(r,a){a===null||a===10?(U(ci(r.output)),r.output=[]):a!=0&&r.output.push(a)},fsync(r){r.output?.length>0&&(U(ci(r.output)),r.output=[])},ioctl_tcgets(r){return{c_iflag:25856,c_oflag:5,c_cflag:191,c_lflag:35387,c_cc:[3,28,127,21,4,0,1,0,17,19,26,0,18,15,23,22,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0]}},ioctl_tcsets(r,a,l){return 0},ioctl_tiocgwinsz(r){return[24,80]}},default_tty1_ops:{put_char(r,a){a===null||a===10?(I(ci(r.output)),r.output=[]):a!=0&&r.output.push(a)},fsync(r){r.output?.length>0&&(I(ci(r.output)),r.output=[])}}},Ht=r=>{pe("internal error: mmapAlloc called but `emscripten_builtin_memalign` native symbol not exported")},ke={ops_table:null,mount(r){return ke.createNode(null,"/",16895,0)},createNode(r,a,l,u){if(M.isBlkdev(l)||M.isFIFO(l))throw new M.ErrnoError(63);ke.ops_table||={dir:{node:{getattr:ke.node_ops.getattr,setattr:ke.node_ops.setattr,lookup:ke.node_ops.lookup,mknod:ke.node_ops.mknod,rename:ke.node_ops.rename,unlink:ke.node_ops.unlink,rmdir:ke.node_ops.rmdir,readdir:ke.node_ops.readdir,symlink:ke.node_ops.symlink},stream:{llseek:ke.stream_ops.llseek}},file:{node:{getattr:ke.node_ops.getattr,setattr:ke.node_ops.setattr},stream:{llseek:ke.stream_ops.llseek,read:ke.stream_ops.read,write:ke.stream_ops.write,mmap:ke.stream_ops.mmap,msync:ke.stream_ops.msync}},link:{node:{getattr:ke.node_ops.getattr,setattr:ke.node_ops.setattr,readlink:ke.node_ops.readlink},stream:{}},chrdev:{node:{getattr:ke.node_ops.getattr,setattr:ke.node_ops.setattr},stream:M.chrdev_stream_ops}};var m=M.createNode(r,a,l,u);return M.isDir(m.mode)?(m.node_ops=ke.ops_table.dir.node,m.stream_ops=ke.ops_table.dir.stream,m.contents={}):M.isFile(m.mode)?(m.node_ops=ke.ops_table.file.node,m.stream_ops=ke.ops_table.file.stream,m.usedBytes=0,m.contents=null):M.isLink(m.mode)?(m.node_ops=ke.ops_table.link.node,m.stream_ops=ke.ops_table.link.stream):M.isChrdev(m.mode)&&(m.node_ops=ke.ops_table.chrdev.node,m.stream_ops=ke.ops_table.chrdev.stream),m.atime=m.mtime=m.ctime=Date.now(),r&&(r.contents[a]=m,r.atime=r.mtime=r.ctime=m.atime),m},getFileDataAsTypedArray(r){return r.contents?r.contents.subarray?r.contents.subarray(0,r.usedBytes):new Uint8Array(r.contents):new Uint8Array(0)},expandFileStorage(r,a){var l=r.contents?r.contents.length:0;if(!(l>=a)){var u=1024*1024;a=Math.max(a,l*(l<u?2:1.125)>>>0),l!=0&&(a=Math.max(a,256));var m=r.contents;r.contents=new Uint8Array(a),r.usedBytes>0&&r.contents.set(m.subarray(0,r.usedBytes),0)}},resizeFileStorage(r,a){if(r.usedBytes!=a)if(a==0)r.contents=null,r.usedBytes=0;else{var l=r.contents;r.contents=new Uint8Array(a),l&&r.contents.set(l.subarray(0,Math.min(a,r.usedBytes))),r.usedBytes=a}},node_ops:{getattr(r){var a={};return a.dev=M.isChrdev(r.mode)?r.id:1,a.ino=r.id,a.mode=r.mode,a.nlink=1,a.uid=0,a.gid=0,a.rdev=r.rdev,M.isDir(r.mode)?a.size=4096:M.isFile(r.mode)?a.size=r.usedBytes:M.isLink(r.mode)?a.size=r.link.length:a.size=0,a.atime=new Date(r.atime),a.mtime=new Date(r.mtime),a.ctime=new Date(r.ctime),a.blksize=4096,a.blocks=Math.ceil(a.size/a.blksize),a},setattr(r,a){for(let l of["mode","atime","mtime","ctime"])a[l]!=null&&(r[l]=a[l]);a.size!==void 0&&ke.resizeFileStorage(r,a.size)},lookup(r,a){throw new M.ErrnoError(44)},mknod(r,a,l,u){return ke.createNode(r,a,l,u)},rename(r,a,l){var u;try{u=M.lookupNode(a,l)}catch{}if(u){if(M.isDir(r.mode))for(var m in u.contents)throw new M.ErrnoError(55);M.hashRemoveNode(u)}delete r.parent.contents[r.name],a.contents[l]=r,r.name=l,a.ctime=a.mtime=r.parent.ctime=r.parent.mtime=Date.now()},unlink(r,a){delete r.contents[a],r.ctime=r.mtime=Date.now()},rmdir(r,a){var l=M.lookupNode(r,a);for(var u in l.contents)throw new M.ErrnoError(55);delete r.contents[a],r.ctime=r.mtime=Date.now()},readdir(r){return[".","..",...Object.keys(r.contents)]},symlink(r,a,l){var u=ke.createNode(r,a,41471,0);return u.link=l,u},readlink(r){if(!M.isLink(r.mode))throw new M.ErrnoError(28);return r.link}},stream_ops:{read(r,a,l,u,m){var v=r.node.contents;if(m>=r.node.usedBytes)return 0;var E=Math.min(r.node.usedBytes-m,u);if(G(E>=0),E>8&&v.subarray)a.set(v.subarray(m,m+E),l);else for(var A=0;A<E;A++)a[l+A]=v[m+A];return E},write(r,a,l,u,m,v){if(G(!(a instanceof ArrayBuffer)),a.buffer===ht.buffer&&(v=!1),!u)return 0;var E=r.node;if(E.mtime=E.ctime=Date.now(),a.subarray&&(!E.contents||E.contents.subarray)){if(v)return G(m===0,"canOwn must imply no weird position inside the file"),E.contents=a.subarray(l,l+u),E.usedBytes=u,u;if(E.usedBytes===0&&m===0)return E.contents=a.slice(l,l+u),E.usedBytes=u,u;if(m+u<=E.usedBytes)return E.contents.set(a.subarray(l,l+u),m),u}if(ke.expandFileStorage(E,m+u),E.contents.subarray&&a.subarray)E.contents.set(a.subarray(l,l+u),m);else for(var A=0;A<u;A++)E.contents[m+A]=a[l+A];return E.usedBytes=Math.max(E.usedBytes,m+u),u},llseek(r,a,l){var u=a;if(l===1?u+=r.position:l===2&&M.isFile(r.node.mode)&&(u+=r.node.usedBytes),u<0)throw new M.ErrnoError(28);return u},mmap(r,a,l,u,m){if(!M.isFile(r.node.mode))throw new M.ErrnoError(43);var v,E,A=r.node.contents;if(!(m&2)&&A&&A.buffer===ht.buffer)E=!1,v=A.byteOffset;else{if(E=!0,v=Ht(a),!v)throw new M.ErrnoError(48);A&&((l>0||l+a<A.length)&&(A.subarray?A=A.subarray(l,l+a):A=Array.prototype.slice.call(A,l,l+a)),ht.set(A,v))}return{ptr:v,allocated:E}},msync(r,a,l,u,m){return ke.stream_ops.write(r,a,0,u,l,!1),0}}},Pt=async r=>{var a=await w(r);return G(a,`Loading data file "${r}" failed (no arrayBuffer).`),new Uint8Array(a)},qt=(...r)=>M.createDataFile(...r),We=r=>{for(var a=r;;){if(!T[r])return r;r=a+Math.random()}},tn=[],Mt=(r,a,l,u)=>{typeof Browser<"u"&&Browser.init();var m=!1;return tn.forEach(v=>{m||v.canHandle(a)&&(v.handle(r,a,l,u),m=!0)}),m},Xn=(r,a,l,u,m,v,E,A,F,X)=>{var K=a?Te.resolve($.join2(r,a)):r,oe=We(`cp ${K}`);function fe(ce){function _e(Ke){X?.(),A||qt(r,a,Ke,u,m,F),v?.(),de(oe)}Mt(ce,K,_e,()=>{E?.(),de(oe)})||_e(ce)}ve(oe),typeof l=="string"?Pt(l).then(fe,E):fe(l)},nn=r=>{var a={r:0,"r+":2,w:577,"w+":578,a:1089,"a+":1090},l=a[r];if(typeof l>"u")throw new Error(`Unknown file open mode: ${r}`);return l},bi=(r,a)=>{var l=0;return r&&(l|=365),a&&(l|=146),l},$n=r=>on(Ih(r)),qn={EPERM:63,ENOENT:44,ESRCH:71,EINTR:27,EIO:29,ENXIO:60,E2BIG:1,ENOEXEC:45,EBADF:8,ECHILD:12,EAGAIN:6,EWOULDBLOCK:6,ENOMEM:48,EACCES:2,EFAULT:21,ENOTBLK:105,EBUSY:10,EEXIST:20,EXDEV:75,ENODEV:43,ENOTDIR:54,EISDIR:31,EINVAL:28,ENFILE:41,EMFILE:33,ENOTTY:59,ETXTBSY:74,EFBIG:22,ENOSPC:51,ESPIPE:70,EROFS:69,EMLINK:34,EPIPE:64,EDOM:18,ERANGE:68,ENOMSG:49,EIDRM:24,ECHRNG:106,EL2NSYNC:156,EL3HLT:107,EL3RST:108,ELNRNG:109,EUNATCH:110,ENOCSI:111,EL2HLT:112,EDEADLK:16,ENOLCK:46,EBADE:113,EBADR:114,EXFULL:115,ENOANO:104,EBADRQC:103,EBADSLT:102,EDEADLOCK:16,EBFONT:101,ENOSTR:100,ENODATA:116,ETIME:117,ENOSR:118,ENONET:119,ENOPKG:120,EREMOTE:121,ENOLINK:47,EADV:122,ESRMNT:123,ECOMM:124,EPROTO:65,EMULTIHOP:36,EDOTDOT:125,EBADMSG:9,ENOTUNIQ:126,EBADFD:127,EREMCHG:128,ELIBACC:129,ELIBBAD:130,ELIBSCN:131,ELIBMAX:132,ELIBEXEC:133,ENOSYS:52,ENOTEMPTY:55,ENAMETOOLONG:37,ELOOP:32,EOPNOTSUPP:138,EPFNOSUPPORT:139,ECONNRESET:15,ENOBUFS:42,EAFNOSUPPORT:5,EPROTOTYPE:67,ENOTSOCK:57,ENOPROTOOPT:50,ESHUTDOWN:140,ECONNREFUSED:14,EADDRINUSE:3,ECONNABORTED:13,ENETUNREACH:40,ENETDOWN:38,ETIMEDOUT:73,EHOSTDOWN:142,EHOSTUNREACH:23,EINPROGRESS:26,EALREADY:7,EDESTADDRREQ:17,EMSGSIZE:35,EPROTONOSUPPORT:66,ESOCKTNOSUPPORT:137,EADDRNOTAVAIL:4,ENETRESET:39,EISCONN:30,ENOTCONN:53,ETOOMANYREFS:141,EUSERS:136,EDQUOT:19,ESTALE:72,ENOTSUP:138,ENOMEDIUM:148,EILSEQ:25,EOVERFLOW:61,ECANCELED:11,ENOTRECOVERABLE:56,EOWNERDEAD:62,ESTRPIPE:135},M={root:null,mounts:[],devices:{},streams:[],nextInode:1,nameTable:null,currentPath:"/",initialized:!1,ignorePermissions:!0,filesystems:null,syncFSRequests:0,readFiles:{},ErrnoError:class extends Error{name="ErrnoError";constructor(r){super(At?$n(r):""),this.errno=r;for(var a in qn)if(qn[a]===r){this.code=a;break}}},FSStream:class{shared={};get object(){return this.node}set object(r){this.node=r}get isRead(){return(this.flags&2097155)!==1}get isWrite(){return(this.flags&2097155)!==0}get isAppend(){return this.flags&1024}get flags(){return this.shared.flags}set flags(r){this.shared.flags=r}get position(){return this.shared.position}set position(r){this.shared.position=r}},FSNode:class{node_ops={};stream_ops={};readMode=365;writeMode=146;mounted=null;constructor(r,a,l,u){r||(r=this),this.parent=r,this.mount=r.mount,this.id=M.nextInode++,this.name=a,this.mode=l,this.rdev=u,this.atime=this.mtime=this.ctime=Date.now()}get read(){return(this.mode&this.readMode)===this.readMode}set read(r){r?this.mode|=this.readMode:this.mode&=~this.readMode}get write(){return(this.mode&this.writeMode)===this.writeMode}set write(r){r?this.mode|=this.writeMode:this.mode&=~this.writeMode}get isFolder(){return M.isDir(this.mode)}get isDevice(){return M.isChrdev(this.mode)}},lookupPath(r,a={}){if(!r)throw new M.ErrnoError(44);a.follow_mount??=!0,$.isAbs(r)||(r=M.cwd()+"/"+r);e:for(var l=0;l<40;l++){for(var u=r.split("/").filter(X=>!!X),m=M.root,v="/",E=0;E<u.length;E++){var A=E===u.length-1;if(A&&a.parent)break;if(u[E]!=="."){if(u[E]===".."){if(v=$.dirname(v),M.isRoot(m)){r=v+"/"+u.slice(E+1).join("/");continue e}else m=m.parent;continue}v=$.join2(v,u[E]);try{m=M.lookupNode(m,u[E])}catch(X){if(X?.errno===44&&A&&a.noent_okay)return{path:v};throw X}if(M.isMountpoint(m)&&(!A||a.follow_mount)&&(m=m.mounted.root),M.isLink(m.mode)&&(!A||a.follow)){if(!m.node_ops.readlink)throw new M.ErrnoError(52);var F=m.node_ops.readlink(m);$.isAbs(F)||(F=$.dirname(v)+"/"+F),r=F+"/"+u.slice(E+1).join("/");continue e}}}return{path:v,node:m}}throw new M.ErrnoError(32)},getPath(r){for(var a;;){if(M.isRoot(r)){var l=r.mount.mountpoint;return a?l[l.length-1]!=="/"?`${l}/${a}`:l+a:l}a=a?`${r.name}/${a}`:r.name,r=r.parent}},hashName(r,a){for(var l=0,u=0;u<a.length;u++)l=(l<<5)-l+a.charCodeAt(u)|0;return(r+l>>>0)%M.nameTable.length},hashAddNode(r){var a=M.hashName(r.parent.id,r.name);r.name_next=M.nameTable[a],M.nameTable[a]=r},hashRemoveNode(r){var a=M.hashName(r.parent.id,r.name);if(M.nameTable[a]===r)M.nameTable[a]=r.name_next;else for(var l=M.nameTable[a];l;){if(l.name_next===r){l.name_next=r.name_next;break}l=l.name_next}},lookupNode(r,a){var l=M.mayLookup(r);if(l)throw new M.ErrnoError(l);for(var u=M.hashName(r.id,a),m=M.nameTable[u];m;m=m.name_next){var v=m.name;if(m.parent.id===r.id&&v===a)return m}return M.lookup(r,a)},createNode(r,a,l,u){G(typeof r=="object");var m=new M.FSNode(r,a,l,u);return M.hashAddNode(m),m},destroyNode(r){M.hashRemoveNode(r)},isRoot(r){return r===r.parent},isMountpoint(r){return!!r.mounted},isFile(r){return(r&61440)===32768},isDir(r){return(r&61440)===16384},isLink(r){return(r&61440)===40960},isChrdev(r){return(r&61440)===8192},isBlkdev(r){return(r&61440)===24576},isFIFO(r){return(r&61440)===4096},isSocket(r){return(r&49152)===49152},flagsToPermissionString(r){var a=["r","w","rw"][r&3];return r&512&&(a+="w"),a},nodePermissions(r,a){return M.ignorePermissions?0:a.includes("r")&&!(r.mode&292)||a.includes("w")&&!(r.mode&146)||a.includes("x")&&!(r.mode&73)?2:0},mayLookup(r){if(!M.isDir(r.mode))return 54;var a=M.nodePermissions(r,"x");return a||(r.node_ops.lookup?0:2)},mayCreate(r,a){if(!M.isDir(r.mode))return 54;try{var l=M.lookupNode(r,a);return 20}catch{}return M.nodePermissions(r,"wx")},mayDelete(r,a,l){var u;try{u=M.lookupNode(r,a)}catch(v){return v.errno}var m=M.nodePermissions(r,"wx");if(m)return m;if(l){if(!M.isDir(u.mode))return 54;if(M.isRoot(u)||M.getPath(u)===M.cwd())return 10}else if(M.isDir(u.mode))return 31;return 0},mayOpen(r,a){return r?M.isLink(r.mode)?32:M.isDir(r.mode)&&(M.flagsToPermissionString(a)!=="r"||a&576)?31:M.nodePermissions(r,M.flagsToPermissionString(a)):44},checkOpExists(r,a){if(!r)throw new M.ErrnoError(a);return r},MAX_OPEN_FDS:4096,nextfd(){for(var r=0;r<=M.MAX_OPEN_FDS;r++)if(!M.streams[r])return r;throw new M.ErrnoError(33)},getStreamChecked(r){var a=M.getStream(r);if(!a)throw new M.ErrnoError(8);return a},getStream:r=>M.streams[r],createStream(r,a=-1){return G(a>=-1),r=Object.assign(new M.FSStream,r),a==-1&&(a=M.nextfd()),r.fd=a,M.streams[a]=r,r},closeStream(r){M.streams[r]=null},dupStream(r,a=-1){var l=M.createStream(r,a);return l.stream_ops?.dup?.(l),l},doSetAttr(r,a,l){var u=r?.stream_ops.setattr,m=u?r:a;u??=a.node_ops.setattr,M.checkOpExists(u,63),u(m,l)},chrdev_stream_ops:{open(r){var a=M.getDevice(r.node.rdev);r.stream_ops=a.stream_ops,r.stream_ops.open?.(r)},llseek(){throw new M.ErrnoError(70)}},major:r=>r>>8,minor:r=>r&255,makedev:(r,a)=>r<<8|a,registerDevice(r,a){M.devices[r]={stream_ops:a}},getDevice:r=>M.devices[r],getMounts(r){for(var a=[],l=[r];l.length;){var u=l.pop();a.push(u),l.push(...u.mounts)}return a},syncfs(r,a){typeof r=="function"&&(a=r,r=!1),M.syncFSRequests++,M.syncFSRequests>1&&I(`warning: ${M.syncFSRequests} FS.syncfs operations in flight at once, probably just doing extra work`);var l=M.getMounts(M.root.mount),u=0;function m(E){return G(M.syncFSRequests>0),M.syncFSRequests--,a(E)}function v(E){if(E)return v.errored?void 0:(v.errored=!0,m(E));++u>=l.length&&m(null)}l.forEach(E=>{if(!E.type.syncfs)return v(null);E.type.syncfs(E,r,v)})},mount(r,a,l){if(typeof r=="string")throw r;var u=l==="/",m=!l,v;if(u&&M.root)throw new M.ErrnoError(10);if(!u&&!m){var E=M.lookupPath(l,{follow_mount:!1});if(l=E.path,v=E.node,M.isMountpoint(v))throw new M.ErrnoError(10);if(!M.isDir(v.mode))throw new M.ErrnoError(54)}var A={type:r,opts:a,mountpoint:l,mounts:[]},F=r.mount(A);return F.mount=A,A.root=F,u?M.root=F:v&&(v.mounted=A,v.mount&&v.mount.mounts.push(A)),F},unmount(r){var a=M.lookupPath(r,{follow_mount:!1});if(!M.isMountpoint(a.node))throw new M.ErrnoError(28);var l=a.node,u=l.mounted,m=M.getMounts(u);Object.keys(M.nameTable).forEach(E=>{for(var A=M.nameTable[E];A;){var F=A.name_next;m.includes(A.mount)&&M.destroyNode(A),A=F}}),l.mounted=null;var v=l.mount.mounts.indexOf(u);G(v!==-1),l.mount.mounts.splice(v,1)},lookup(r,a){return r.node_ops.lookup(r,a)},mknod(r,a,l){var u=M.lookupPath(r,{parent:!0}),m=u.node,v=$.basename(r);if(!v)throw new M.ErrnoError(28);if(v==="."||v==="..")throw new M.ErrnoError(20);var E=M.mayCreate(m,v);if(E)throw new M.ErrnoError(E);if(!m.node_ops.mknod)throw new M.ErrnoError(63);return m.node_ops.mknod(m,v,a,l)},statfs(r){return M.statfsNode(M.lookupPath(r,{follow:!0}).node)},statfsStream(r){return M.statfsNode(r.node)},statfsNode(r){var a={bsize:4096,frsize:4096,blocks:1e6,bfree:5e5,bavail:5e5,files:M.nextInode,ffree:M.nextInode-1,fsid:42,flags:2,namelen:255};return r.node_ops.statfs&&Object.assign(a,r.node_ops.statfs(r.mount.opts.root)),a},create(r,a=438){return a&=4095,a|=32768,M.mknod(r,a,0)},mkdir(r,a=511){return a&=1023,a|=16384,M.mknod(r,a,0)},mkdirTree(r,a){var l=r.split("/"),u="";for(var m of l)if(m){(u||$.isAbs(r))&&(u+="/"),u+=m;try{M.mkdir(u,a)}catch(v){if(v.errno!=20)throw v}}},mkdev(r,a,l){return typeof l>"u"&&(l=a,a=438),a|=8192,M.mknod(r,a,l)},symlink(r,a){if(!Te.resolve(r))throw new M.ErrnoError(44);var l=M.lookupPath(a,{parent:!0}),u=l.node;if(!u)throw new M.ErrnoError(44);var m=$.basename(a),v=M.mayCreate(u,m);if(v)throw new M.ErrnoError(v);if(!u.node_ops.symlink)throw new M.ErrnoError(63);return u.node_ops.symlink(u,m,r)},rename(r,a){var l=$.dirname(r),u=$.dirname(a),m=$.basename(r),v=$.basename(a),E,A,F;if(E=M.lookupPath(r,{parent:!0}),A=E.node,E=M.lookupPath(a,{parent:!0}),F=E.node,!A||!F)throw new M.ErrnoError(44);if(A.mount!==F.mount)throw new M.ErrnoError(75);var X=M.lookupNode(A,m),K=Te.relative(r,u);if(K.charAt(0)!==".")throw new M.ErrnoError(28);if(K=Te.relative(a,l),K.charAt(0)!==".")throw new M.ErrnoError(55);var oe;try{oe=M.lookupNode(F,v)}catch{}if(X!==oe){var fe=M.isDir(X.mode),ce=M.mayDelete(A,m,fe);if(ce)throw new M.ErrnoError(ce);if(ce=oe?M.mayDelete(F,v,fe):M.mayCreate(F,v),ce)throw new M.ErrnoError(ce);if(!A.node_ops.rename)throw new M.ErrnoError(63);if(M.isMountpoint(X)||oe&&M.isMountpoint(oe))throw new M.ErrnoError(10);if(F!==A&&(ce=M.nodePermissions(A,"w"),ce))throw new M.ErrnoError(ce);M.hashRemoveNode(X);try{A.node_ops.rename(X,F,v),X.parent=F}catch(_e){throw _e}finally{M.hashAddNode(X)}}},rmdir(r){var a=M.lookupPath(r,{parent:!0}),l=a.node,u=$.basename(r),m=M.lookupNode(l,u),v=M.mayDelete(l,u,!0);if(v)throw new M.ErrnoError(v);if(!l.node_ops.rmdir)throw new M.ErrnoError(63);if(M.isMountpoint(m))throw new M.ErrnoError(10);l.node_ops.rmdir(l,u),M.destroyNode(m)},readdir(r){var a=M.lookupPath(r,{follow:!0}),l=a.node,u=M.checkOpExists(l.node_ops.readdir,54);return u(l)},unlink(r){var a=M.lookupPath(r,{parent:!0}),l=a.node;if(!l)throw new M.ErrnoError(44);var u=$.basename(r),m=M.lookupNode(l,u),v=M.mayDelete(l,u,!1);if(v)throw new M.ErrnoError(v);if(!l.node_ops.unlink)throw new M.ErrnoError(63);if(M.isMountpoint(m))throw new M.ErrnoError(10);l.node_ops.unlink(l,u),M.destroyNode(m)},readlink(r){var a=M.lookupPath(r),l=a.node;if(!l)throw new M.ErrnoError(44);if(!l.node_ops.readlink)throw new M.ErrnoError(28);return l.node_ops.readlink(l)},stat(r,a){var l=M.lookupPath(r,{follow:!a}),u=l.node,m=M.checkOpExists(u.node_ops.getattr,63);return m(u)},fstat(r){var a=M.getStreamChecked(r),l=a.node,u=a.stream_ops.getattr,m=u?a:l;return u??=l.node_ops.getattr,M.checkOpExists(u,63),u(m)},lstat(r){return M.stat(r,!0)},doChmod(r,a,l,u){M.doSetAttr(r,a,{mode:l&4095|a.mode&-4096,ctime:Date.now(),dontFollow:u})},chmod(r,a,l){var u;if(typeof r=="string"){var m=M.lookupPath(r,{follow:!l});u=m.node}else u=r;M.doChmod(null,u,a,l)},lchmod(r,a){M.chmod(r,a,!0)},fchmod(r,a){var l=M.getStreamChecked(r);M.doChmod(l,l.node,a,!1)},doChown(r,a,l){M.doSetAttr(r,a,{timestamp:Date.now(),dontFollow:l})},chown(r,a,l,u){var m;if(typeof r=="string"){var v=M.lookupPath(r,{follow:!u});m=v.node}else m=r;M.doChown(null,m,u)},lchown(r,a,l){M.chown(r,a,l,!0)},fchown(r,a,l){var u=M.getStreamChecked(r);M.doChown(u,u.node,!1)},doTruncate(r,a,l){if(M.isDir(a.mode))throw new M.ErrnoError(31);if(!M.isFile(a.mode))throw new M.ErrnoError(28);var u=M.nodePermissions(a,"w");if(u)throw new M.ErrnoError(u);M.doSetAttr(r,a,{size:l,timestamp:Date.now()})},truncate(r,a){if(a<0)throw new M.ErrnoError(28);var l;if(typeof r=="string"){var u=M.lookupPath(r,{follow:!0});l=u.node}else l=r;M.doTruncate(null,l,a)},ftruncate(r,a){var l=M.getStreamChecked(r);if(a<0||(l.flags&2097155)===0)throw new M.ErrnoError(28);M.doTruncate(l,l.node,a)},utime(r,a,l){var u=M.lookupPath(r,{follow:!0}),m=u.node,v=M.checkOpExists(m.node_ops.setattr,63);v(m,{atime:a,mtime:l})},open(r,a,l=438){if(r==="")throw new M.ErrnoError(44);a=typeof a=="string"?nn(a):a,a&64?l=l&4095|32768:l=0;var u,m;if(typeof r=="object")u=r;else{m=r.endsWith("/");var v=M.lookupPath(r,{follow:!(a&131072),noent_okay:!0});u=v.node,r=v.path}var E=!1;if(a&64)if(u){if(a&128)throw new M.ErrnoError(20)}else{if(m)throw new M.ErrnoError(31);u=M.mknod(r,l|511,0),E=!0}if(!u)throw new M.ErrnoError(44);if(M.isChrdev(u.mode)&&(a&=-513),a&65536&&!M.isDir(u.mode))throw new M.ErrnoError(54);if(!E){var A=M.mayOpen(u,a);if(A)throw new M.ErrnoError(A)}a&512&&!E&&M.truncate(u,0),a&=-131713;var F=M.createStream({node:u,path:M.getPath(u),flags:a,seekable:!0,position:0,stream_ops:u.stream_ops,ungotten:[],error:!1});return F.stream_ops.open&&F.stream_ops.open(F),E&&M.chmod(u,l&511),t.logReadFiles&&!(a&1)&&(r in M.readFiles||(M.readFiles[r]=1)),F},close(r){if(M.isClosed(r))throw new M.ErrnoError(8);r.getdents&&(r.getdents=null);try{r.stream_ops.close&&r.stream_ops.close(r)}catch(a){throw a}finally{M.closeStream(r.fd)}r.fd=null},isClosed(r){return r.fd===null},llseek(r,a,l){if(M.isClosed(r))throw new M.ErrnoError(8);if(!r.seekable||!r.stream_ops.llseek)throw new M.ErrnoError(70);if(l!=0&&l!=1&&l!=2)throw new M.ErrnoError(28);return r.position=r.stream_ops.llseek(r,a,l),r.ungotten=[],r.position},read(r,a,l,u,m){if(G(l>=0),u<0||m<0)throw new M.ErrnoError(28);if(M.isClosed(r))throw new M.ErrnoError(8);if((r.flags&2097155)===1)throw new M.ErrnoError(8);if(M.isDir(r.node.mode))throw new M.ErrnoError(31);if(!r.stream_ops.read)throw new M.ErrnoError(28);var v=typeof m<"u";if(!v)m=r.position;else if(!r.seekable)throw new M.ErrnoError(70);var E=r.stream_ops.read(r,a,l,u,m);return v||(r.position+=E),E},write(r,a,l,u,m,v){if(G(l>=0),u<0||m<0)throw new M.ErrnoError(28);if(M.isClosed(r))throw new M.ErrnoError(8);if((r.flags&2097155)===0)throw new M.ErrnoError(8);if(M.isDir(r.node.mode))throw new M.ErrnoError(31);if(!r.stream_ops.write)throw new M.ErrnoError(28);r.seekable&&r.flags&1024&&M.llseek(r,0,2);var E=typeof m<"u";if(!E)m=r.position;else if(!r.seekable)throw new M.ErrnoError(70);var A=r.stream_ops.write(r,a,l,u,m,v);return E||(r.position+=A),A},mmap(r,a,l,u,m){if((u&2)!==0&&(m&2)===0&&(r.flags&2097155)!==2)throw new M.ErrnoError(2);if((r.flags&2097155)===1)throw new M.ErrnoError(2);if(!r.stream_ops.mmap)throw new M.ErrnoError(43);if(!a)throw new M.ErrnoError(28);return r.stream_ops.mmap(r,a,l,u,m)},msync(r,a,l,u,m){return G(l>=0),r.stream_ops.msync?r.stream_ops.msync(r,a,l,u,m):0},ioctl(r,a,l){if(!r.stream_ops.ioctl)throw new M.ErrnoError(59);return r.stream_ops.ioctl(r,a,l)},readFile(r,a={}){if(a.flags=a.flags||0,a.encoding=a.encoding||"binary",a.encoding!=="utf8"&&a.encoding!=="binary")throw new Error(`Invalid encoding type "${a.encoding}"`);var l=M.open(r,a.flags),u=M.stat(r),m=u.size,v=new Uint8Array(m);return M.read(l,v,0,m,0),a.encoding==="utf8"&&(v=ci(v)),M.close(l),v},writeFile(r,a,l={}){l.flags=l.flags||577;var u=M.open(r,l.flags,l.mode);if(typeof a=="string"&&(a=new Uint8Array(ft(a,!0))),ArrayBuffer.isView(a))M.write(u,a,0,a.byteLength,void 0,l.canOwn);else throw new Error("Unsupported data type");M.close(u)},cwd:()=>M.currentPath,chdir(r){var a=M.lookupPath(r,{follow:!0});if(a.node===null)throw new M.ErrnoError(44);if(!M.isDir(a.node.mode))throw new M.ErrnoError(54);var l=M.nodePermissions(a.node,"x");if(l)throw new M.ErrnoError(l);M.currentPath=a.path},createDefaultDirectories(){M.mkdir("/tmp"),M.mkdir("/home"),M.mkdir("/home/web_user")},createDefaultDevices(){M.mkdir("/dev"),M.registerDevice(M.makedev(1,3),{read:()=>0,write:(u,m,v,E,A)=>E,llseek:()=>0}),M.mkdev("/dev/null",M.makedev(1,3)),st.register(M.makedev(5,0),st.default_tty_ops),st.register(M.makedev(6,0),st.default_tty1_ops),M.mkdev("/dev/tty",M.makedev(5,0)),M.mkdev("/dev/tty1",M.makedev(6,0));var r=new Uint8Array(1024),a=0,l=()=>(a===0&&(Ge(r),a=r.byteLength),r[--a]);M.createDevice("/dev","random",l),M.createDevice("/dev","urandom",l),M.mkdir("/dev/shm"),M.mkdir("/dev/shm/tmp")},createSpecialDirectories(){M.mkdir("/proc");var r=M.mkdir("/proc/self");M.mkdir("/proc/self/fd"),M.mount({mount(){var a=M.createNode(r,"fd",16895,73);return a.stream_ops={llseek:ke.stream_ops.llseek},a.node_ops={lookup(l,u){var m=+u,v=M.getStreamChecked(m),E={parent:null,mount:{mountpoint:"fake"},node_ops:{readlink:()=>v.path},id:m+1};return E.parent=E,E},readdir(){return Array.from(M.streams.entries()).filter(([l,u])=>u).map(([l,u])=>l.toString())}},a}},{},"/proc/self/fd")},createStandardStreams(r,a,l){r?M.createDevice("/dev","stdin",r):M.symlink("/dev/tty","/dev/stdin"),a?M.createDevice("/dev","stdout",null,a):M.symlink("/dev/tty","/dev/stdout"),l?M.createDevice("/dev","stderr",null,l):M.symlink("/dev/tty1","/dev/stderr");var u=M.open("/dev/stdin",0),m=M.open("/dev/stdout",1),v=M.open("/dev/stderr",1);G(u.fd===0,`invalid handle for stdin (${u.fd})`),G(m.fd===1,`invalid handle for stdout (${m.fd})`),G(v.fd===2,`invalid handle for stderr (${v.fd})`)},staticInit(){M.nameTable=new Array(4096),M.mount(ke,{},"/"),M.createDefaultDirectories(),M.createDefaultDevices(),M.createSpecialDirectories(),M.filesystems={MEMFS:ke}},init(r,a,l){G(!M.initialized,"FS.init was previously called. If you want to initialize later with custom parameters, remove any earlier calls (note that one is automatically added to the generated code)"),M.initialized=!0,r??=t.stdin,a??=t.stdout,l??=t.stderr,M.createStandardStreams(r,a,l)},quit(){M.initialized=!1,Al(0);for(var r of M.streams)r&&M.close(r)},findObject(r,a){var l=M.analyzePath(r,a);return l.exists?l.object:null},analyzePath(r,a){try{var l=M.lookupPath(r,{follow:!a});r=l.path}catch{}var u={isRoot:!1,exists:!1,error:0,name:null,path:null,object:null,parentExists:!1,parentPath:null,parentObject:null};try{var l=M.lookupPath(r,{parent:!0});u.parentExists=!0,u.parentPath=l.path,u.parentObject=l.node,u.name=$.basename(r),l=M.lookupPath(r,{follow:!a}),u.exists=!0,u.path=l.path,u.object=l.node,u.name=l.node.name,u.isRoot=l.path==="/"}catch(m){u.error=m.errno}return u},createPath(r,a,l,u){r=typeof r=="string"?r:M.getPath(r);for(var m=a.split("/").reverse();m.length;){var v=m.pop();if(v){var E=$.join2(r,v);try{M.mkdir(E)}catch(A){if(A.errno!=20)throw A}r=E}}return E},createFile(r,a,l,u,m){var v=$.join2(typeof r=="string"?r:M.getPath(r),a),E=bi(u,m);return M.create(v,E)},createDataFile(r,a,l,u,m,v){var E=a;r&&(r=typeof r=="string"?r:M.getPath(r),E=a?$.join2(r,a):r);var A=bi(u,m),F=M.create(E,A);if(l){if(typeof l=="string"){for(var X=new Array(l.length),K=0,oe=l.length;K<oe;++K)X[K]=l.charCodeAt(K);l=X}M.chmod(F,A|146);var fe=M.open(F,577);M.write(fe,l,0,l.length,0,v),M.close(fe),M.chmod(F,A)}},createDevice(r,a,l,u){var m=$.join2(typeof r=="string"?r:M.getPath(r),a),v=bi(!!l,!!u);M.createDevice.major??=64;var E=M.makedev(M.createDevice.major++,0);return M.registerDevice(E,{open(A){A.seekable=!1},close(A){u?.buffer?.length&&u(10)},read(A,F,X,K,oe){for(var fe=0,ce=0;ce<K;ce++){var _e;try{_e=l()}catch{throw new M.ErrnoError(29)}if(_e===void 0&&fe===0)throw new M.ErrnoError(6);if(_e==null)break;fe++,F[X+ce]=_e}return fe&&(A.node.atime=Date.now()),fe},write(A,F,X,K,oe){for(var fe=0;fe<K;fe++)try{u(F[X+fe])}catch{throw new M.ErrnoError(29)}return K&&(A.node.mtime=A.node.ctime=Date.now()),fe}}),M.mkdev(m,v,E)},forceLoadFile(r){if(r.isDevice||r.isFolder||r.link||r.contents)return!0;if(typeof XMLHttpRequest<"u")throw new Error("Lazy loading should have been performed (contents set) in createLazyFile, but it was not. Lazy loading only works in web workers. Use --embed-file or --preload-file in emcc on the main thread.");try{r.contents=R(r.url),r.usedBytes=r.contents.length}catch{throw new M.ErrnoError(29)}},createLazyFile(r,a,l,u,m){class v{lengthKnown=!1;chunks=[];get(ce){if(!(ce>this.length-1||ce<0)){var _e=ce%this.chunkSize,Ke=ce/this.chunkSize|0;return this.getter(Ke)[_e]}}setDataGetter(ce){this.getter=ce}cacheLength(){var ce=new XMLHttpRequest;if(ce.open("HEAD",l,!1),ce.send(null),!(ce.status>=200&&ce.status<300||ce.status===304))throw new Error("Couldn't load "+l+". Status: "+ce.status);var _e=Number(ce.getResponseHeader("Content-length")),Ke,vt=(Ke=ce.getResponseHeader("Accept-Ranges"))&&Ke==="bytes",pt=(Ke=ce.getResponseHeader("Content-Encoding"))&&Ke==="gzip",Ut=1024*1024;vt||(Ut=_e);var bt=(Jt,pn)=>{if(Jt>pn)throw new Error("invalid range ("+Jt+", "+pn+") or no bytes requested!");if(pn>_e-1)throw new Error("only "+_e+" bytes available! programmer error!");var Ft=new XMLHttpRequest;if(Ft.open("GET",l,!1),_e!==Ut&&Ft.setRequestHeader("Range","bytes="+Jt+"-"+pn),Ft.responseType="arraybuffer",Ft.overrideMimeType&&Ft.overrideMimeType("text/plain; charset=x-user-defined"),Ft.send(null),!(Ft.status>=200&&Ft.status<300||Ft.status===304))throw new Error("Couldn't load "+l+". Status: "+Ft.status);return Ft.response!==void 0?new Uint8Array(Ft.response||[]):ft(Ft.responseText||"",!0)},cn=this;cn.setDataGetter(Jt=>{var pn=Jt*Ut,Ft=(Jt+1)*Ut-1;if(Ft=Math.min(Ft,_e-1),typeof cn.chunks[Jt]>"u"&&(cn.chunks[Jt]=bt(pn,Ft)),typeof cn.chunks[Jt]>"u")throw new Error("doXHR failed!");return cn.chunks[Jt]}),(pt||!_e)&&(Ut=_e=1,_e=this.getter(0).length,Ut=_e,U("LazyFiles on gzip forces download of the whole file when length is accessed")),this._length=_e,this._chunkSize=Ut,this.lengthKnown=!0}get length(){return this.lengthKnown||this.cacheLength(),this._length}get chunkSize(){return this.lengthKnown||this.cacheLength(),this._chunkSize}}if(typeof XMLHttpRequest<"u"){if(!s)throw"Cannot do synchronous binary XHRs outside webworkers in modern browsers. Use --embed-file or --preload-file in emcc";var E=new v,A={isDevice:!1,contents:E}}else var A={isDevice:!1,url:l};var F=M.createFile(r,a,A,u,m);A.contents?F.contents=A.contents:A.url&&(F.contents=null,F.url=A.url),Object.defineProperties(F,{usedBytes:{get:function(){return this.contents.length}}});var X={},K=Object.keys(F.stream_ops);K.forEach(fe=>{var ce=F.stream_ops[fe];X[fe]=(..._e)=>(M.forceLoadFile(F),ce(..._e))});function oe(fe,ce,_e,Ke,vt){var pt=fe.node.contents;if(vt>=pt.length)return 0;var Ut=Math.min(pt.length-vt,Ke);if(G(Ut>=0),pt.slice)for(var bt=0;bt<Ut;bt++)ce[_e+bt]=pt[vt+bt];else for(var bt=0;bt<Ut;bt++)ce[_e+bt]=pt.get(vt+bt);return Ut}return X.read=(fe,ce,_e,Ke,vt)=>(M.forceLoadFile(F),oe(fe,ce,_e,Ke,vt)),X.mmap=(fe,ce,_e,Ke,vt)=>{M.forceLoadFile(F);var pt=Ht(ce);if(!pt)throw new M.ErrnoError(48);return oe(fe,ht,pt,ce,_e),{ptr:pt,allocated:!0}},F.stream_ops=X,F},absolutePath(){pe("FS.absolutePath has been removed; use PATH_FS.resolve instead")},createFolder(){pe("FS.createFolder has been removed; use FS.mkdir instead")},createLink(){pe("FS.createLink has been removed; use FS.symlink instead")},joinPath(){pe("FS.joinPath has been removed; use PATH.join instead")},mmapAlloc(){pe("FS.mmapAlloc has been replaced by the top level function mmapAlloc")},standardizePath(){pe("FS.standardizePath has been removed; use PATH.normalize instead")}},ct={DEFAULT_POLLMASK:5,calculateAt(r,a,l){if($.isAbs(a))return a;var u;if(r===-100)u=M.cwd();else{var m=ct.getStreamFromFD(r);u=m.path}if(a.length==0){if(!l)throw new M.ErrnoError(44);return u}return u+"/"+a},writeStat(r,a){Le[r>>2]=a.dev,Le[r+4>>2]=a.mode,qe[r+8>>2]=a.nlink,Le[r+12>>2]=a.uid,Le[r+16>>2]=a.gid,Le[r+20>>2]=a.rdev,W[r+24>>3]=BigInt(a.size),Le[r+32>>2]=4096,Le[r+36>>2]=a.blocks;var l=a.atime.getTime(),u=a.mtime.getTime(),m=a.ctime.getTime();return W[r+40>>3]=BigInt(Math.floor(l/1e3)),qe[r+48>>2]=l%1e3*1e3*1e3,W[r+56>>3]=BigInt(Math.floor(u/1e3)),qe[r+64>>2]=u%1e3*1e3*1e3,W[r+72>>3]=BigInt(Math.floor(m/1e3)),qe[r+80>>2]=m%1e3*1e3*1e3,W[r+88>>3]=BigInt(a.ino),0},writeStatFs(r,a){Le[r+4>>2]=a.bsize,Le[r+40>>2]=a.bsize,Le[r+8>>2]=a.blocks,Le[r+12>>2]=a.bfree,Le[r+16>>2]=a.bavail,Le[r+20>>2]=a.files,Le[r+24>>2]=a.ffree,Le[r+28>>2]=a.fsid,Le[r+44>>2]=a.flags,Le[r+36>>2]=a.namelen},doMsync(r,a,l,u,m){if(!M.isFile(a.node.mode))throw new M.ErrnoError(43);if(u&2)return 0;var v=Rt.slice(r,r+l);M.msync(a,v,m,l,u)},getStreamFromFD(r){var a=M.getStreamChecked(r);return a},varargs:void 0,getStr(r){var a=on(r);return a}};function Mn(r,a,l){try{var u=ct.getStreamFromFD(r);if(G(!l),u.fd===a)return-28;if(a<0||a>=M.MAX_OPEN_FDS)return-8;var m=M.getStream(a);return m&&M.close(m),M.dupStream(u,a).fd}catch(v){if(typeof M>"u"||v.name!=="ErrnoError")throw v;return-v.errno}}var Dt=()=>{G(ct.varargs!=null);var r=Le[+ct.varargs>>2];return ct.varargs+=4,r},Bt=Dt;function Dn(r,a,l){ct.varargs=l;try{var u=ct.getStreamFromFD(r);switch(a){case 0:{var m=Dt();if(m<0)return-28;for(;M.streams[m];)m++;var v;return v=M.dupStream(u,m),v.fd}case 1:case 2:return 0;case 3:return u.flags;case 4:{var m=Dt();return u.flags|=m,0}case 12:{var m=Bt(),E=0;return St[m+E>>1]=2,0}case 13:case 14:return 0}return-28}catch(A){if(typeof M>"u"||A.name!=="ErrnoError")throw A;return-A.errno}}function $s(r,a){try{return ct.writeStat(a,M.fstat(r))}catch(l){if(typeof M>"u"||l.name!=="ErrnoError")throw l;return-l.errno}}function Zd(r,a,l){ct.varargs=l;try{var u=ct.getStreamFromFD(r);switch(a){case 21509:return u.tty?0:-59;case 21505:{if(!u.tty)return-59;if(u.tty.ops.ioctl_tcgets){var m=u.tty.ops.ioctl_tcgets(u),v=Bt();Le[v>>2]=m.c_iflag||0,Le[v+4>>2]=m.c_oflag||0,Le[v+8>>2]=m.c_cflag||0,Le[v+12>>2]=m.c_lflag||0;for(var E=0;E<32;E++)ht[v+E+17]=m.c_cc[E]||0;return 0}return 0}case 21510:case 21511:case 21512:return u.tty?0:-59;case 21506:case 21507:case 21508:{if(!u.tty)return-59;if(u.tty.ops.ioctl_tcsets){for(var v=Bt(),A=Le[v>>2],F=Le[v+4>>2],X=Le[v+8>>2],K=Le[v+12>>2],oe=[],E=0;E<32;E++)oe.push(ht[v+E+17]);return u.tty.ops.ioctl_tcsets(u.tty,a,{c_iflag:A,c_oflag:F,c_cflag:X,c_lflag:K,c_cc:oe})}return 0}case 21519:{if(!u.tty)return-59;var v=Bt();return Le[v>>2]=0,0}case 21520:return u.tty?-28:-59;case 21531:{var v=Bt();return M.ioctl(u,a,v)}case 21523:{if(!u.tty)return-59;if(u.tty.ops.ioctl_tiocgwinsz){var fe=u.tty.ops.ioctl_tiocgwinsz(u.tty),v=Bt();St[v>>1]=fe[0],St[v+2>>1]=fe[1]}return 0}case 21524:return u.tty?0:-59;case 21515:return u.tty?0:-59;default:return-28}}catch(ce){if(typeof M>"u"||ce.name!=="ErrnoError")throw ce;return-ce.errno}}function Kd(r,a){try{return r=ct.getStr(r),ct.writeStat(a,M.lstat(r))}catch(l){if(typeof M>"u"||l.name!=="ErrnoError")throw l;return-l.errno}}function Qd(r,a,l,u){try{a=ct.getStr(a);var m=u&256,v=u&4096;return u=u&-6401,G(!u,`unknown flags in __syscall_newfstatat: ${u}`),a=ct.calculateAt(r,a,v),ct.writeStat(l,m?M.lstat(a):M.stat(a))}catch(E){if(typeof M>"u"||E.name!=="ErrnoError")throw E;return-E.errno}}function ef(r,a,l,u){ct.varargs=u;try{a=ct.getStr(a),a=ct.calculateAt(r,a);var m=u?Dt():0;return M.open(a,l,m).fd}catch(v){if(typeof M>"u"||v.name!=="ErrnoError")throw v;return-v.errno}}function tf(r,a){try{return r=ct.getStr(r),ct.writeStat(a,M.stat(r))}catch(l){if(typeof M>"u"||l.name!=="ErrnoError")throw l;return-l.errno}}var nf=()=>pe("native code called abort()"),Yt=r=>{for(var a="";;){var l=Rt[r++];if(!l)return a;a+=String.fromCharCode(l)}},dr={},Hi={},qs={},Zr=class extends Error{constructor(a){super(a),this.name="BindingError"}},_t=r=>{throw new Zr(r)};function rf(r,a,l={}){var u=a.name;if(r||_t(`type "${u}" must have a positive integer typeid pointer`),Hi.hasOwnProperty(r)){if(l.ignoreDuplicateRegistrations)return;_t(`Cannot register type '${u}' twice`)}if(Hi[r]=a,delete qs[r],dr.hasOwnProperty(r)){var m=dr[r];delete dr[r],m.forEach(v=>v())}}function Rn(r,a,l={}){if(a.argPackAdvance===void 0)throw new TypeError("registerType registeredInstance requires argPackAdvance");return rf(r,a,l)}var nh=(r,a,l)=>{switch(a){case 1:return l?u=>ht[u]:u=>Rt[u];case 2:return l?u=>St[u>>1]:u=>Qt[u>>1];case 4:return l?u=>Le[u>>2]:u=>qe[u>>2];case 8:return l?u=>W[u>>3]:u=>fn[u>>3];default:throw new TypeError(`invalid integer width (${a}): ${r}`)}},Wi=r=>{if(r===null)return"null";var a=typeof r;return a==="object"||a==="array"||a==="function"?r.toString():""+r},ih=(r,a,l,u)=>{if(a<l||a>u)throw new TypeError(`Passing a number "${Wi(a)}" from JS side to C/C++ side to an argument of type "${r}", which is outside the valid range [${l}, ${u}]!`)},sf=(r,a,l,u,m)=>{a=Yt(a);let v=u===0n,E=A=>A;if(v){let A=l*8;E=F=>BigInt.asUintN(A,F),m=E(m)}Rn(r,{name:a,fromWireType:E,toWireType:(A,F)=>{if(typeof F=="number")F=BigInt(F);else if(typeof F!="bigint")throw new TypeError(`Cannot convert "${Wi(F)}" to ${this.name}`);return ih(a,F,u,m),F},argPackAdvance:Yn,readValueFromPointer:nh(a,l,!v),destructorFunction:null})},Yn=8,af=(r,a,l,u)=>{a=Yt(a),Rn(r,{name:a,fromWireType:function(m){return!!m},toWireType:function(m,v){return v?l:u},argPackAdvance:Yn,readValueFromPointer:function(m){return this.fromWireType(Rt[m])},destructorFunction:null})},of=r=>({count:r.count,deleteScheduled:r.deleteScheduled,preservePointerOnDelete:r.preservePointerOnDelete,ptr:r.ptr,ptrType:r.ptrType,smartPtr:r.smartPtr,smartPtrType:r.smartPtrType}),gl=r=>{function a(l){return l.$$.ptrType.registeredClass.name}_t(a(r)+" instance already deleted")},_l=!1,rh=r=>{},lf=r=>{r.smartPtr?r.smartPtrType.rawDestructor(r.smartPtr):r.ptrType.registeredClass.rawDestructor(r.ptr)},sh=r=>{r.count.value-=1;var a=r.count.value===0;a&&lf(r)},ah=(r,a,l)=>{if(a===l)return r;if(l.baseClass===void 0)return null;var u=ah(r,a,l.baseClass);return u===null?null:l.downcast(u)},oh={},cf={},hf=(r,a)=>{for(a===void 0&&_t("ptr should not be undefined");r.baseClass;)a=r.upcast(a),r=r.baseClass;return a},uf=(r,a)=>(a=hf(r,a),cf[a]),df=class extends Error{constructor(a){super(a),this.name="InternalError"}},Ys=r=>{throw new df(r)},js=(r,a)=>{(!a.ptrType||!a.ptr)&&Ys("makeClassHandle requires ptr and ptrType");var l=!!a.smartPtrType,u=!!a.smartPtr;return l!==u&&Ys("Both smartPtrType and smartPtr must be specified"),a.count={value:1},Kr(Object.create(r,{$$:{value:a,writable:!0}}))};function lh(r){var a=this.getPointee(r);if(!a)return this.destructor(r),null;var l=uf(this.registeredClass,a);if(l!==void 0){if(l.$$.count.value===0)return l.$$.ptr=a,l.$$.smartPtr=r,l.clone();var u=l.clone();return this.destructor(r),u}function m(){return this.isSmartPointer?js(this.registeredClass.instancePrototype,{ptrType:this.pointeeType,ptr:a,smartPtrType:this,smartPtr:r}):js(this.registeredClass.instancePrototype,{ptrType:this,ptr:r})}var v=this.registeredClass.getActualType(a),E=oh[v];if(!E)return m.call(this);var A;this.isConst?A=E.constPointerType:A=E.pointerType;var F=ah(a,this.registeredClass,A.registeredClass);return F===null?m.call(this):this.isSmartPointer?js(A.registeredClass.instancePrototype,{ptrType:A,ptr:F,smartPtrType:this,smartPtr:r}):js(A.registeredClass.instancePrototype,{ptrType:A,ptr:F})}var Kr=r=>typeof FinalizationRegistry>"u"?(Kr=a=>a,r):(_l=new FinalizationRegistry(a=>{console.warn(a.leakWarning),sh(a.$$)}),Kr=a=>{var l=a.$$,u=!!l.smartPtr;if(u){var m={$$:l},v=l.ptrType.registeredClass,E=new Error(`Embind found a leaked C++ instance ${v.name} <${Ot(l.ptr)}>.
We'll free it automatically in this case, but this functionality is not reliable across various environments.
Make sure to invoke .delete() manually once you're done with the instance instead.
Originally allocated`);"captureStackTrace"in Error&&Error.captureStackTrace(E,lh),m.leakWarning=E.stack.replace(/^Error: /,""),_l.register(a,m,a)}return a},rh=a=>_l.unregister(a),Kr(r)),Js=[],ff=()=>{for(;Js.length;){var r=Js.pop();r.$$.deleteScheduled=!1,r.delete()}},ch,pf=()=>{let r=Zs.prototype;Object.assign(r,{isAliasOf(l){if(!(this instanceof Zs)||!(l instanceof Zs))return!1;var u=this.$$.ptrType.registeredClass,m=this.$$.ptr;l.$$=l.$$;for(var v=l.$$.ptrType.registeredClass,E=l.$$.ptr;u.baseClass;)m=u.upcast(m),u=u.baseClass;for(;v.baseClass;)E=v.upcast(E),v=v.baseClass;return u===v&&m===E},clone(){if(this.$$.ptr||gl(this),this.$$.preservePointerOnDelete)return this.$$.count.value+=1,this;var l=Kr(Object.create(Object.getPrototypeOf(this),{$$:{value:of(this.$$)}}));return l.$$.count.value+=1,l.$$.deleteScheduled=!1,l},delete(){this.$$.ptr||gl(this),this.$$.deleteScheduled&&!this.$$.preservePointerOnDelete&&_t("Object already scheduled for deletion"),rh(this),sh(this.$$),this.$$.preservePointerOnDelete||(this.$$.smartPtr=void 0,this.$$.ptr=void 0)},isDeleted(){return!this.$$.ptr},deleteLater(){return this.$$.ptr||gl(this),this.$$.deleteScheduled&&!this.$$.preservePointerOnDelete&&_t("Object already scheduled for deletion"),Js.push(this),Js.length===1&&ch&&ch(ff),this.$$.deleteScheduled=!0,this}});let a=Symbol.dispose;a&&(r[a]=r.delete)};function Zs(){}var Ks=(r,a)=>Object.defineProperty(a,"name",{value:r}),vl=(r,a,l)=>{if(r[a].overloadTable===void 0){var u=r[a];r[a]=function(...m){return r[a].overloadTable.hasOwnProperty(m.length)||_t(`Function '${l}' called with an invalid number of arguments (${m.length}) - expects one of (${r[a].overloadTable})!`),r[a].overloadTable[m.length].apply(this,m)},r[a].overloadTable=[],r[a].overloadTable[u.argCount]=u}},yl=(r,a,l)=>{t.hasOwnProperty(r)?((l===void 0||t[r].overloadTable!==void 0&&t[r].overloadTable[l]!==void 0)&&_t(`Cannot register public name '${r}' twice`),vl(t,r,r),t[r].overloadTable.hasOwnProperty(l)&&_t(`Cannot register multiple overloads of a function with the same number of arguments (${l})!`),t[r].overloadTable[l]=a):(t[r]=a,t[r].argCount=l)},mf=48,gf=57,_f=r=>{G(typeof r=="string"),r=r.replace(/[^a-zA-Z0-9_]/g,"$");var a=r.charCodeAt(0);return a>=mf&&a<=gf?`_${r}`:r};function vf(r,a,l,u,m,v,E,A){this.name=r,this.constructor=a,this.instancePrototype=l,this.rawDestructor=u,this.baseClass=m,this.getActualType=v,this.upcast=E,this.downcast=A,this.pureVirtualFunctions=[]}var Qs=(r,a,l)=>{for(;a!==l;)a.upcast||_t(`Expected null or instance of ${l.name}, got an instance of ${a.name}`),r=a.upcast(r),a=a.baseClass;return r};function yf(r,a){if(a===null)return this.isReference&&_t(`null is not a valid ${this.name}`),0;a.$$||_t(`Cannot pass "${Wi(a)}" as a ${this.name}`),a.$$.ptr||_t(`Cannot pass deleted object as a pointer of type ${this.name}`);var l=a.$$.ptrType.registeredClass,u=Qs(a.$$.ptr,l,this.registeredClass);return u}function xf(r,a){var l;if(a===null)return this.isReference&&_t(`null is not a valid ${this.name}`),this.isSmartPointer?(l=this.rawConstructor(),r!==null&&r.push(this.rawDestructor,l),l):0;(!a||!a.$$)&&_t(`Cannot pass "${Wi(a)}" as a ${this.name}`),a.$$.ptr||_t(`Cannot pass deleted object as a pointer of type ${this.name}`),!this.isConst&&a.$$.ptrType.isConst&&_t(`Cannot convert argument of type ${a.$$.smartPtrType?a.$$.smartPtrType.name:a.$$.ptrType.name} to parameter type ${this.name}`);var u=a.$$.ptrType.registeredClass;if(l=Qs(a.$$.ptr,u,this.registeredClass),this.isSmartPointer)switch(a.$$.smartPtr===void 0&&_t("Passing raw pointer to smart pointer is illegal"),this.sharingPolicy){case 0:a.$$.smartPtrType===this?l=a.$$.smartPtr:_t(`Cannot convert argument of type ${a.$$.smartPtrType?a.$$.smartPtrType.name:a.$$.ptrType.name} to parameter type ${this.name}`);break;case 1:l=a.$$.smartPtr;break;case 2:if(a.$$.smartPtrType===this)l=a.$$.smartPtr;else{var m=a.clone();l=this.rawShare(l,jt.toHandle(()=>m.delete())),r!==null&&r.push(this.rawDestructor,l)}break;default:_t("Unsupporting sharing policy")}return l}function Sf(r,a){if(a===null)return this.isReference&&_t(`null is not a valid ${this.name}`),0;a.$$||_t(`Cannot pass "${Wi(a)}" as a ${this.name}`),a.$$.ptr||_t(`Cannot pass deleted object as a pointer of type ${this.name}`),a.$$.ptrType.isConst&&_t(`Cannot convert argument of type ${a.$$.ptrType.name} to parameter type ${this.name}`);var l=a.$$.ptrType.registeredClass,u=Qs(a.$$.ptr,l,this.registeredClass);return u}function ea(r){return this.fromWireType(qe[r>>2])}var Mf=()=>{Object.assign(ta.prototype,{getPointee(r){return this.rawGetPointee&&(r=this.rawGetPointee(r)),r},destructor(r){this.rawDestructor?.(r)},argPackAdvance:Yn,readValueFromPointer:ea,fromWireType:lh})};function ta(r,a,l,u,m,v,E,A,F,X,K){this.name=r,this.registeredClass=a,this.isReference=l,this.isConst=u,this.isSmartPointer=m,this.pointeeType=v,this.sharingPolicy=E,this.rawGetPointee=A,this.rawConstructor=F,this.rawShare=X,this.rawDestructor=K,!m&&a.baseClass===void 0?u?(this.toWireType=yf,this.destructorFunction=null):(this.toWireType=Sf,this.destructorFunction=null):this.toWireType=xf}var hh=(r,a,l)=>{t.hasOwnProperty(r)||Ys("Replacing nonexistent public symbol"),t[r].overloadTable!==void 0&&l!==void 0?t[r].overloadTable[l]=a:(t[r]=a,t[r].argCount=l)},uh=[],na,be=r=>{var a=uh[r];return a||(uh[r]=a=na.get(r)),G(na.get(r)==a,"JavaScript-side Wasm function table mirror is out of date!"),a},jn=(r,a,l=!1)=>{G(!l,"Async bindings are only supported with JSPI."),r=Yt(r);function u(){var v=be(a);return v}var m=u();return typeof m!="function"&&_t(`unknown function pointer with signature ${r}: ${a}`),m};class bf extends Error{}var dh=r=>{var a=Ph(r),l=Yt(a);return Nn(a),l},Xi=(r,a)=>{var l=[],u={};function m(v){if(!u[v]&&!Hi[v]){if(qs[v]){qs[v].forEach(m);return}l.push(v),u[v]=!0}}throw a.forEach(m),new bf(`${r}: `+l.map(dh).join([", "]))},Fn=(r,a,l)=>{r.forEach(A=>qs[A]=a);function u(A){var F=l(A);F.length!==r.length&&Ys("Mismatched type converter count");for(var X=0;X<r.length;++X)Rn(r[X],F[X])}var m=new Array(a.length),v=[],E=0;a.forEach((A,F)=>{Hi.hasOwnProperty(A)?m[F]=Hi[A]:(v.push(A),dr.hasOwnProperty(A)||(dr[A]=[]),dr[A].push(()=>{m[F]=Hi[A],++E,E===v.length&&u(m)}))}),v.length===0&&u(m)},wf=(r,a,l,u,m,v,E,A,F,X,K,oe,fe)=>{K=Yt(K),v=jn(m,v),A&&=jn(E,A),X&&=jn(F,X),fe=jn(oe,fe);var ce=_f(K);yl(ce,function(){Xi(`Cannot construct ${K} due to unbound types`,[u])}),Fn([r,a,l],u?[u]:[],_e=>{_e=_e[0];var Ke,vt;u?(Ke=_e.registeredClass,vt=Ke.instancePrototype):vt=Zs.prototype;var pt=Ks(K,function(...Ft){if(Object.getPrototypeOf(this)!==Ut)throw new Zr(`Use 'new' to construct ${K}`);if(bt.constructor_body===void 0)throw new Zr(`${K} has no accessible constructor`);var Yi=bt.constructor_body[Ft.length];if(Yi===void 0)throw new Zr(`Tried to invoke ctor of ${K} with invalid number of parameters (${Ft.length}) - expected (${Object.keys(bt.constructor_body).toString()}) parameters instead!`);return Yi.apply(this,Ft)}),Ut=Object.create(vt,{constructor:{value:pt}});pt.prototype=Ut;var bt=new vf(K,pt,Ut,fe,Ke,v,A,X);bt.baseClass&&(bt.baseClass.__derivedClasses??=[],bt.baseClass.__derivedClasses.push(bt));var cn=new ta(K,bt,!0,!1,!1),Jt=new ta(K+"*",bt,!1,!1,!1),pn=new ta(K+" const*",bt,!1,!0,!1);return oh[r]={pointerType:Jt,constPointerType:pn},hh(ce,pt),[cn,Jt,pn]})},xl=r=>{for(;r.length;){var a=r.pop(),l=r.pop();l(a)}};function fh(r){for(var a=1;a<r.length;++a)if(r[a]!==null&&r[a].destructorFunction===void 0)return!0;return!1}function Ef(r,a,l,u,m){if(r<a||r>l){var v=a==l?a:`${a} to ${l}`;m(`function ${u} called with ${r} arguments, expected ${v}`)}}function Tf(r,a,l,u){var m=fh(r),v=r.length-2,E=[],A=["fn"];a&&A.push("thisWired");for(var F=0;F<v;++F)E.push(`arg${F}`),A.push(`arg${F}Wired`);E=E.join(","),A=A.join(",");var X=`return function (${E}) {
`;X+=`checkArgCount(arguments.length, minArgs, maxArgs, humanName, throwBindingError);
`,m&&(X+=`var destructors = [];
`);var K=m?"destructors":"null",oe=["humanName","throwBindingError","invoker","fn","runDestructors","retType","classParam"];a&&(X+=`var thisWired = classParam['toWireType'](${K}, this);
`);for(var F=0;F<v;++F)X+=`var arg${F}Wired = argType${F}['toWireType'](${K}, arg${F});
`,oe.push(`argType${F}`);X+=(l||u?"var rv = ":"")+`invoker(${A});
`;var fe=l?"rv":"";if(m)X+=`runDestructors(destructors);
`;else for(var F=a?1:2;F<r.length;++F){var ce=F===1?"thisWired":"arg"+(F-2)+"Wired";r[F].destructorFunction!==null&&(X+=`${ce}_dtor(${ce});
`,oe.push(`${ce}_dtor`))}return l&&(X+=`var ret = retType['fromWireType'](rv);
return ret;
`),X+=`}
`,oe.push("checkArgCount","minArgs","maxArgs"),X=`if (arguments.length !== ${oe.length}){ throw new Error(humanName + "Expected ${oe.length} closure arguments " + arguments.length + " given."); }
${X}`,[oe,X]}function Af(r){for(var a=r.length-2,l=r.length-1;l>=2&&r[l].optional;--l)a--;return a}function ia(r,a,l,u,m,v){var E=a.length;E<2&&_t("argTypes array size mismatch! Must at least get return value and 'this' types!"),G(!v,"Async bindings are only supported with JSPI.");for(var A=a[1]!==null&&l!==null,F=fh(a),X=a[0].name!=="void",K=E-2,oe=Af(a),fe=[r,_t,u,m,xl,a[0],a[1]],ce=0;ce<E-2;++ce)fe.push(a[ce+2]);if(!F)for(var ce=A?1:2;ce<a.length;++ce)a[ce].destructorFunction!==null&&fe.push(a[ce].destructorFunction);fe.push(Ef,oe,K);let[_e,Ke]=Tf(a,A,X,v);var vt=new Function(..._e,Ke)(...fe);return Ks(r,vt)}var ra=(r,a)=>{for(var l=[],u=0;u<r;u++)l.push(qe[a+u*4>>2]);return l},Sl=r=>{r=r.trim();let a=r.indexOf("(");return a===-1?r:(G(r.endsWith(")"),"Parentheses for argument names should match."),r.slice(0,a))},Cf=(r,a,l,u,m,v,E,A,F)=>{var X=ra(l,u);a=Yt(a),a=Sl(a),v=jn(m,v,A),Fn([],[r],K=>{K=K[0];var oe=`${K.name}.${a}`;function fe(){Xi(`Cannot call ${oe} due to unbound types`,X)}a.startsWith("@@")&&(a=Symbol[a.substring(2)]);var ce=K.registeredClass.constructor;return ce[a]===void 0?(fe.argCount=l-1,ce[a]=fe):(vl(ce,a,oe),ce[a].overloadTable[l-1]=fe),Fn([],X,_e=>{var Ke=[_e[0],null].concat(_e.slice(1)),vt=ia(oe,Ke,null,v,E,A);if(ce[a].overloadTable===void 0?(vt.argCount=l-1,ce[a]=vt):ce[a].overloadTable[l-1]=vt,K.registeredClass.__derivedClasses)for(let pt of K.registeredClass.__derivedClasses)pt.constructor.hasOwnProperty(a)||(pt.constructor[a]=vt);return[]}),[]})},Rf=(r,a,l,u,m,v)=>{G(a>0);var E=ra(a,l);m=jn(u,m);var A=[v],F=[];Fn([],[r],X=>{X=X[0];var K=`constructor ${X.name}`;if(X.registeredClass.constructor_body===void 0&&(X.registeredClass.constructor_body=[]),X.registeredClass.constructor_body[a-1]!==void 0)throw new Zr(`Cannot register multiple constructors with identical number of parameters (${a-1}) for class '${X.name}'! Overload resolution is currently only performed using the parameter count, not actual type info!`);return X.registeredClass.constructor_body[a-1]=()=>{Xi(`Cannot construct ${X.name} due to unbound types`,E)},Fn([],E,oe=>(oe.splice(1,0,null),X.registeredClass.constructor_body[a-1]=ia(K,oe,null,m,v),[])),[]})},Pf=(r,a,l,u,m,v,E,A,F,X)=>{var K=ra(l,u);a=Yt(a),a=Sl(a),v=jn(m,v,F),Fn([],[r],oe=>{oe=oe[0];var fe=`${oe.name}.${a}`;a.startsWith("@@")&&(a=Symbol[a.substring(2)]),A&&oe.registeredClass.pureVirtualFunctions.push(a);function ce(){Xi(`Cannot call ${fe} due to unbound types`,K)}var _e=oe.registeredClass.instancePrototype,Ke=_e[a];return Ke===void 0||Ke.overloadTable===void 0&&Ke.className!==oe.name&&Ke.argCount===l-2?(ce.argCount=l-2,ce.className=oe.name,_e[a]=ce):(vl(_e,a,fe),_e[a].overloadTable[l-2]=ce),Fn([],K,vt=>{var pt=ia(fe,vt,oe,v,E,F);return _e[a].overloadTable===void 0?(pt.argCount=l-2,_e[a]=pt):_e[a].overloadTable[l-2]=pt,[]}),[]})},ph=(r,a,l)=>(r instanceof Object||_t(`${l} with invalid "this": ${r}`),r instanceof a.registeredClass.constructor||_t(`${l} incompatible with "this" of type ${r.constructor.name}`),r.$$.ptr||_t(`cannot call emscripten binding method ${l} on deleted object`),Qs(r.$$.ptr,r.$$.ptrType.registeredClass,a.registeredClass)),If=(r,a,l,u,m,v,E,A,F,X)=>{a=Yt(a),m=jn(u,m),Fn([],[r],K=>{K=K[0];var oe=`${K.name}.${a}`,fe={get(){Xi(`Cannot access ${oe} due to unbound types`,[l,E])},enumerable:!0,configurable:!0};return F?fe.set=()=>Xi(`Cannot access ${oe} due to unbound types`,[l,E]):fe.set=ce=>_t(oe+" is a read-only property"),Object.defineProperty(K.registeredClass.instancePrototype,a,fe),Fn([],F?[l,E]:[l],ce=>{var _e=ce[0],Ke={get(){var pt=ph(this,K,oe+" getter");return _e.fromWireType(m(v,pt))},enumerable:!0};if(F){F=jn(A,F);var vt=ce[1];Ke.set=function(pt){var Ut=ph(this,K,oe+" setter"),bt=[];F(X,Ut,vt.toWireType(bt,pt)),xl(bt)}}return Object.defineProperty(K.registeredClass.instancePrototype,a,Ke),[]}),[]})},Lf=(r,a,l)=>{r=Yt(r),Fn([],[a],u=>(u=u[0],t[r]=u.fromWireType(l),[]))},mh=[],Jn=[0,1,,1,null,1,!0,1,!1,1],Ml=r=>{r>9&&--Jn[r+1]===0&&(G(Jn[r]!==void 0,"Decref for unallocated handle."),Jn[r]=void 0,mh.push(r))},jt={toValue:r=>(r||_t(`Cannot use deleted val. handle = ${r}`),G(r===2||Jn[r]!==void 0&&r%2===0,`invalid handle: ${r}`),Jn[r]),toHandle:r=>{switch(r){case void 0:return 2;case null:return 4;case!0:return 6;case!1:return 8;default:{let a=mh.pop()||Jn.length;return Jn[a]=r,Jn[a+1]=1,a}}}},gh={name:"emscripten::val",fromWireType:r=>{var a=jt.toValue(r);return Ml(r),a},toWireType:(r,a)=>jt.toHandle(a),argPackAdvance:Yn,readValueFromPointer:ea,destructorFunction:null},_h=r=>Rn(r,gh),Df=(r,a,l)=>{switch(a){case 1:return l?function(u){return this.fromWireType(ht[u])}:function(u){return this.fromWireType(Rt[u])};case 2:return l?function(u){return this.fromWireType(St[u>>1])}:function(u){return this.fromWireType(Qt[u>>1])};case 4:return l?function(u){return this.fromWireType(Le[u>>2])}:function(u){return this.fromWireType(qe[u>>2])};default:throw new TypeError(`invalid integer width (${a}): ${r}`)}},Ff=(r,a,l,u)=>{a=Yt(a);function m(){}m.values={},Rn(r,{name:a,constructor:m,fromWireType:function(v){return this.constructor.values[v]},toWireType:(v,E)=>E.value,argPackAdvance:Yn,readValueFromPointer:Df(a,l,u),destructorFunction:null}),yl(a,m)},sa=(r,a)=>{var l=Hi[r];return l===void 0&&_t(`${a} has unknown type ${dh(r)}`),l},Nf=(r,a,l)=>{var u=sa(r,"enum");a=Yt(a);var m=u.constructor,v=Object.create(u.constructor.prototype,{value:{value:l},constructor:{value:Ks(`${u.name}_${a}`,function(){})}});m.values[l]=v,m[a]=v},Uf=(r,a)=>{switch(a){case 4:return function(l){return this.fromWireType(an[l>>2])};case 8:return function(l){return this.fromWireType(en[l>>3])};default:throw new TypeError(`invalid float width (${a}): ${r}`)}},Of=(r,a,l)=>{a=Yt(a),Rn(r,{name:a,fromWireType:u=>u,toWireType:(u,m)=>{if(typeof m!="number"&&typeof m!="boolean")throw new TypeError(`Cannot convert ${Wi(m)} to ${this.name}`);return m},argPackAdvance:Yn,readValueFromPointer:Uf(a,l),destructorFunction:null})},Bf=(r,a,l,u,m,v,E,A)=>{var F=ra(a,l);r=Yt(r),r=Sl(r),m=jn(u,m,E),yl(r,function(){Xi(`Cannot call ${r} due to unbound types`,F)},a-1),Fn([],F,X=>{var K=[X[0],null].concat(X.slice(1));return hh(r,ia(r,K,null,m,v,E),a-1),[]})},kf=(r,a,l,u,m)=>{a=Yt(a);let v=u===0,E=F=>F;if(v){var A=32-8*l;E=F=>F<<A>>>A,m=E(m)}Rn(r,{name:a,fromWireType:E,toWireType:(F,X)=>{if(typeof X!="number"&&typeof X!="boolean")throw new TypeError(`Cannot convert "${Wi(X)}" to ${a}`);return ih(a,X,u,m),X},argPackAdvance:Yn,readValueFromPointer:nh(a,l,u!==0),destructorFunction:null})},zf=(r,a,l)=>{var u=[Int8Array,Uint8Array,Int16Array,Uint16Array,Int32Array,Uint32Array,Float32Array,Float64Array,BigInt64Array,BigUint64Array],m=u[a];function v(E){var A=qe[E>>2],F=qe[E+4>>2];return new m(ht.buffer,F,A)}l=Yt(l),Rn(r,{name:l,fromWireType:v,argPackAdvance:Yn,readValueFromPointer:v},{ignoreDuplicateRegistrations:!0})},Gf=Object.assign({optional:!0},gh),Vf=(r,a)=>{Rn(r,Gf)},$i=(r,a,l)=>(G(typeof l=="number","stringToUTF8(str, outPtr, maxBytesToWrite) is missing the third parameter that specifies the length of the output buffer!"),it(r,Rt,a,l)),Hf=(r,a)=>{a=Yt(a);var l=!0;Rn(r,{name:a,fromWireType(u){var m=qe[u>>2],v=u+4,E;if(l)for(var A=v,F=0;F<=m;++F){var X=v+F;if(F==m||Rt[X]==0){var K=X-A,oe=on(A,K);E===void 0?E=oe:(E+="\0",E+=oe),A=X+1}}else{for(var fe=new Array(m),F=0;F<m;++F)fe[F]=String.fromCharCode(Rt[v+F]);E=fe.join("")}return Nn(u),E},toWireType(u,m){m instanceof ArrayBuffer&&(m=new Uint8Array(m));var v,E=typeof m=="string";E||ArrayBuffer.isView(m)&&m.BYTES_PER_ELEMENT==1||_t("Cannot pass non-string to std::string"),l&&E?v=Ve(m):v=m.length;var A=Tl(4+v+1),F=A+4;if(qe[A>>2]=v,E)if(l)$i(m,F,v+1);else for(var X=0;X<v;++X){var K=m.charCodeAt(X);K>255&&(Nn(A),_t("String has UTF-16 code units that do not fit in 8 bits")),Rt[F+X]=K}else Rt.set(m,F);return u!==null&&u.push(Nn,A),A},argPackAdvance:Yn,readValueFromPointer:ea,destructorFunction(u){Nn(u)}})},vh=typeof TextDecoder<"u"?new TextDecoder("utf-16le"):void 0,Wf=(r,a)=>{G(r%2==0,"Pointer passed to UTF16ToString must be aligned to two bytes!");for(var l=r>>1,u=l+a/2,m=l;!(m>=u)&&Qt[m];)++m;if(m-l>16&&vh)return vh.decode(Qt.subarray(l,m));for(var v="",E=l;!(E>=u);++E){var A=Qt[E];if(A==0)break;v+=String.fromCharCode(A)}return v},Xf=(r,a,l)=>{if(G(a%2==0,"Pointer passed to stringToUTF16 must be aligned to two bytes!"),G(typeof l=="number","stringToUTF16(str, outPtr, maxBytesToWrite) is missing the third parameter that specifies the length of the output buffer!"),l??=2147483647,l<2)return 0;l-=2;for(var u=a,m=l<r.length*2?l/2:r.length,v=0;v<m;++v){var E=r.charCodeAt(v);St[a>>1]=E,a+=2}return St[a>>1]=0,a-u},$f=r=>r.length*2,qf=(r,a)=>{G(r%4==0,"Pointer passed to UTF32ToString must be aligned to four bytes!");for(var l="",u=0;!(u>=a/4);u++){var m=Le[r+u*4>>2];if(!m)break;l+=String.fromCodePoint(m)}return l},Yf=(r,a,l)=>{if(G(a%4==0,"Pointer passed to stringToUTF32 must be aligned to four bytes!"),G(typeof l=="number","stringToUTF32(str, outPtr, maxBytesToWrite) is missing the third parameter that specifies the length of the output buffer!"),l??=2147483647,l<4)return 0;for(var u=a,m=u+l-4,v=0;v<r.length;++v){var E=r.codePointAt(v);if(E>65535&&v++,Le[a>>2]=E,a+=4,a+4>m)break}return Le[a>>2]=0,a-u},jf=r=>{for(var a=0,l=0;l<r.length;++l){var u=r.codePointAt(l);u>65535&&l++,a+=4}return a},Jf=(r,a,l)=>{l=Yt(l);var u,m,v,E;a===2?(u=Wf,m=Xf,E=$f,v=A=>Qt[A>>1]):a===4&&(u=qf,m=Yf,E=jf,v=A=>qe[A>>2]),Rn(r,{name:l,fromWireType:A=>{for(var F=qe[A>>2],X,K=A+4,oe=0;oe<=F;++oe){var fe=A+4+oe*a;if(oe==F||v(fe)==0){var ce=fe-K,_e=u(K,ce);X===void 0?X=_e:(X+="\0",X+=_e),K=fe+a}}return Nn(A),X},toWireType:(A,F)=>{typeof F!="string"&&_t(`Cannot pass non-string to C++ string type ${l}`);var X=E(F),K=Tl(4+X+a);return qe[K>>2]=X/a,m(F,K+4,X+a),A!==null&&A.push(Nn,K),K},argPackAdvance:Yn,readValueFromPointer:ea,destructorFunction(A){Nn(A)}})},Zf=(r,a)=>{_h(r)},Kf=(r,a)=>{a=Yt(a),Rn(r,{isVoid:!0,name:a,argPackAdvance:0,fromWireType:()=>{},toWireType:(l,u)=>{}})},Qf=()=>{throw new me},yh=(r,a,l)=>{var u=[],m=r.toWireType(u,l);return u.length&&(qe[a>>2]=jt.toHandle(u)),m},ep=(r,a,l)=>(r=jt.toValue(r),a=sa(a,"emval::as"),yh(a,l,r)),aa=[],tp=(r,a,l,u)=>(r=aa[r],a=jt.toValue(a),r(null,a,l,u)),np={},bl=r=>{var a=np[r];return a===void 0?Yt(r):a},ip=(r,a,l,u,m)=>(r=aa[r],a=jt.toValue(a),l=bl(l),r(a,a[l],u,m)),xh=()=>globalThis,rp=r=>r===0?jt.toHandle(xh()):(r=bl(r),jt.toHandle(xh()[r])),sp=r=>{var a=aa.length;return aa.push(r),a},ap=(r,a)=>{for(var l=new Array(r),u=0;u<r;++u)l[u]=sa(qe[a+u*4>>2],`parameter ${u}`);return l},op=(r,a,l)=>{var u=ap(r,a),m=u.shift();r--;var v=`return function (obj, func, destructorsRef, args) {
`,E=0,A=[];l===0&&A.push("obj");for(var F=["retType"],X=[m],K=0;K<r;++K)A.push(`arg${K}`),F.push(`argType${K}`),X.push(u[K]),v+=`  var arg${K} = argType${K}.readValueFromPointer(args${E?"+"+E:""});
`,E+=u[K].argPackAdvance;var oe=l===1?"new func":"func.call";v+=`  var rv = ${oe}(${A.join(", ")});
`,m.isVoid||(F.push("emval_returnValue"),X.push(yh),v+=`  return emval_returnValue(retType, destructorsRef, rv);
`),v+=`};
`;var fe=new Function(...F,v)(...X),ce=`methodCaller<(${u.map(_e=>_e.name).join(", ")}) => ${m.name}>`;return sp(Ks(ce,fe))},lp=(r,a)=>(r=jt.toValue(r),a=jt.toValue(a),jt.toHandle(r[a])),cp=r=>{r>9&&(Jn[r+1]+=1)},hp=r=>(r=jt.toValue(r),typeof r=="number"),up=r=>(r=jt.toValue(r),typeof r=="string"),dp=()=>jt.toHandle([]),fp=r=>jt.toHandle(bl(r)),pp=r=>{var a=jt.toValue(r);xl(a),Ml(r)},mp=(r,a)=>{r=sa(r,"_emval_take_value");var l=r.readValueFromPointer(a);return jt.toHandle(l)},gp=r=>{throw r=jt.toValue(r),r},_p=r=>r%4===0&&(r%100!==0||r%400===0),vp=[0,31,60,91,121,152,182,213,244,274,305,335],yp=[0,31,59,90,120,151,181,212,243,273,304,334],Sh=r=>{var a=_p(r.getFullYear()),l=a?vp:yp,u=l[r.getMonth()]+r.getDate()-1;return u},xp=9007199254740992,Sp=-9007199254740992,wl=r=>r<Sp||r>xp?NaN:Number(r);function Mp(r,a){r=wl(r);var l=new Date(r*1e3);Le[a>>2]=l.getSeconds(),Le[a+4>>2]=l.getMinutes(),Le[a+8>>2]=l.getHours(),Le[a+12>>2]=l.getDate(),Le[a+16>>2]=l.getMonth(),Le[a+20>>2]=l.getFullYear()-1900,Le[a+24>>2]=l.getDay();var u=Sh(l)|0;Le[a+28>>2]=u,Le[a+36>>2]=-(l.getTimezoneOffset()*60);var m=new Date(l.getFullYear(),0,1),v=new Date(l.getFullYear(),6,1).getTimezoneOffset(),E=m.getTimezoneOffset(),A=(v!=E&&l.getTimezoneOffset()==Math.min(E,v))|0;Le[a+32>>2]=A}var bp=function(r){var a=(()=>{var l=new Date(Le[r+20>>2]+1900,Le[r+16>>2],Le[r+12>>2],Le[r+8>>2],Le[r+4>>2],Le[r>>2],0),u=Le[r+32>>2],m=l.getTimezoneOffset(),v=new Date(l.getFullYear(),0,1),E=new Date(l.getFullYear(),6,1).getTimezoneOffset(),A=v.getTimezoneOffset(),F=Math.min(A,E);if(u<0)Le[r+32>>2]=+(E!=A&&F==m);else if(u>0!=(F==m)){var X=Math.max(A,E),K=u>0?F:X;l.setTime(l.getTime()+(K-m)*6e4)}Le[r+24>>2]=l.getDay();var oe=Sh(l)|0;Le[r+28>>2]=oe,Le[r>>2]=l.getSeconds(),Le[r+4>>2]=l.getMinutes(),Le[r+8>>2]=l.getHours(),Le[r+12>>2]=l.getDate(),Le[r+16>>2]=l.getMonth(),Le[r+20>>2]=l.getYear();var fe=l.getTime();return isNaN(fe)?-1:fe/1e3})();return BigInt(a)},wp=(r,a,l,u)=>{var m=new Date().getFullYear(),v=new Date(m,0,1),E=new Date(m,6,1),A=v.getTimezoneOffset(),F=E.getTimezoneOffset(),X=Math.max(A,F);qe[r>>2]=X*60,Le[a>>2]=+(A!=F);var K=ce=>{var _e=ce>=0?"-":"+",Ke=Math.abs(ce),vt=String(Math.floor(Ke/60)).padStart(2,"0"),pt=String(Ke%60).padStart(2,"0");return`UTC${_e}${vt}${pt}`},oe=K(A),fe=K(F);G(oe),G(fe),G(Ve(oe)<=16,`timezone name truncated to fit in TZNAME_MAX (${oe})`),G(Ve(fe)<=16,`timezone name truncated to fit in TZNAME_MAX (${fe})`),F<A?($i(oe,l,17),$i(fe,u,17)):($i(oe,u,17),$i(fe,l,17))},Mh=()=>performance.now(),bh=()=>Date.now(),Ep=1,Tp=r=>r>=0&&r<=3;function Ap(r,a,l){if(a=wl(a),!Tp(r))return 28;var u;if(r===0)u=bh();else if(Ep)u=Mh();else return 52;var m=Math.round(u*1e3*1e3);return W[l>>3]=BigInt(m),0}var oa=[],Cp=(r,a)=>{G(Array.isArray(oa)),G(a%16==0),oa.length=0;for(var l;l=Rt[r++];){var u=String.fromCharCode(l),m=["d","f","i","p"];m.push("j"),G(m.includes(u),`Invalid character ${l}("${u}") in readEmAsmArgs! Use only [${m}], and do not specify "v" for void return argument.`);var v=l!=105;v&=l!=112,a+=v&&a%8?4:0,oa.push(l==112?qe[a>>2]:l==106?W[a>>3]:l==105?Le[a>>2]:en[a>>3]),a+=v?8:4}return oa},Rp=(r,a,l)=>{var u=Cp(a,l);return G(Rh.hasOwnProperty(r),`No EM_ASM constant found at address ${r}.  The loaded WebAssembly file is likely out of sync with the generated JavaScript.`),Rh[r](...u)},Pp=(r,a,l)=>Rp(r,a,l),wh=()=>2147483648,Ip=()=>wh(),Lp=(r,a)=>(G(a,"alignment argument is required"),Math.ceil(r/a)*a),Dp=r=>{var a=Vt.buffer,l=(r-a.byteLength+65535)/65536|0;try{return Vt.grow(l),Nt(),1}catch(u){I(`growMemory: Attempted to grow heap from ${a.byteLength} bytes to ${r} bytes, but got error: ${u}`)}},Fp=r=>{var a=Rt.length;r>>>=0,G(r>a);var l=wh();if(r>l)return I(`Cannot enlarge memory, requested ${r} bytes, but the limit is ${l} bytes!`),!1;for(var u=1;u<=4;u*=2){var m=a*(1+.2/u);m=Math.min(m,r+100663296);var v=Math.min(l,Lp(Math.max(r,m),65536)),E=Dp(v);if(E)return!0}return I(`Failed to grow the heap from ${a} bytes to ${v} bytes, not enough memory!`),!1},El={},Np=()=>f||"./this.program",Qr=()=>{if(!Qr.strings){var r=(typeof navigator=="object"&&navigator.language||"C").replace("-","_")+".UTF-8",a={USER:"web_user",LOGNAME:"web_user",PATH:"/",PWD:"/",HOME:"/home/web_user",LANG:r,_:Np()};for(var l in El)El[l]===void 0?delete a[l]:a[l]=El[l];var u=[];for(var l in a)u.push(`${l}=${a[l]}`);Qr.strings=u}return Qr.strings},Up=(r,a)=>{var l=0,u=0;for(var m of Qr()){var v=a+l;qe[r+u>>2]=v,l+=$i(m,v,1/0)+1,u+=4}return 0},Op=(r,a)=>{var l=Qr();qe[r>>2]=l.length;var u=0;for(var m of l)u+=Ve(m)+1;return qe[a>>2]=u,0},Eh=0,Th=()=>Et||Eh>0,Bp=r=>{ie=r,Th()||(t.onExit?.(r),z=!0),p(r,new Ae(r))},kp=(r,a)=>{if(ie=r,Qg(),Th()&&!a){var l=`program exited (with status: ${r}), but keepRuntimeAlive() is set (counter=${Eh}) due to an async operation, so halting execution but not exiting the runtime or preventing further async execution (you can use emscripten_force_exit, if you want to force a true shutdown)`;dt?.(l),I(l)}Bp(r)},zp=kp;function Gp(r){try{var a=ct.getStreamFromFD(r);return M.close(a),0}catch(l){if(typeof M>"u"||l.name!=="ErrnoError")throw l;return l.errno}}var Vp=(r,a,l,u)=>{for(var m=0,v=0;v<l;v++){var E=qe[a>>2],A=qe[a+4>>2];a+=8;var F=M.read(r,ht,E,A,u);if(F<0)return-1;if(m+=F,F<A)break;typeof u<"u"&&(u+=F)}return m};function Hp(r,a,l,u){try{var m=ct.getStreamFromFD(r),v=Vp(m,a,l);return qe[u>>2]=v,0}catch(E){if(typeof M>"u"||E.name!=="ErrnoError")throw E;return E.errno}}function Wp(r,a,l,u){a=wl(a);try{if(isNaN(a))return 61;var m=ct.getStreamFromFD(r);return M.llseek(m,a,l),W[u>>3]=BigInt(m.position),m.getdents&&a===0&&l===0&&(m.getdents=null),0}catch(v){if(typeof M>"u"||v.name!=="ErrnoError")throw v;return v.errno}}var Xp=(r,a,l,u)=>{for(var m=0,v=0;v<l;v++){var E=qe[a>>2],A=qe[a+4>>2];a+=8;var F=M.write(r,ht,E,A,u);if(F<0)return-1;if(m+=F,F<A)break;typeof u<"u"&&(u+=F)}return m};function $p(r,a,l,u){try{var m=ct.getStreamFromFD(r),v=Xp(m,a,l);return qe[u>>2]=v,0}catch(E){if(typeof M>"u"||E.name!=="ErrnoError")throw E;return E.errno}}var qp=r=>r,Yp=r=>{var a=t["_"+r];return G(a,"Cannot call unknown function "+r+", make sure it is exported"),a},jp=(r,a)=>{G(r.length>=0,"writeArrayToMemory array must have a length (should be an array or typed array)"),ht.set(r,a)},la=r=>Nh(r),Jp=r=>{var a=Ve(r)+1,l=la(a);return $i(r,l,a),l},Ah=(r,a,l,u,m)=>{var v={string:_e=>{var Ke=0;return _e!=null&&_e!==0&&(Ke=Jp(_e)),Ke},array:_e=>{var Ke=la(_e.length);return jp(_e,Ke),Ke}};function E(_e){return a==="string"?on(_e):a==="boolean"?!!_e:_e}var A=Yp(r),F=[],X=0;if(G(a!=="array",'Return type should not be "array".'),u)for(var K=0;K<u.length;K++){var oe=v[l[K]];oe?(X===0&&(X=ge()),F[K]=oe(u[K])):F[K]=u[K]}var fe=A(...F);function ce(_e){return X!==0&&ye(X),E(_e)}return fe=ce(fe),fe},Zp=(r,a,l,u)=>(...m)=>Ah(r,a,l,m,u),Kp=(...r)=>M.createPath(...r),Qp=(...r)=>M.unlink(...r),em=(...r)=>M.createLazyFile(...r),tm=(...r)=>M.createDevice(...r),nm=r=>ca(r),im=r=>Rl(r),rm=r=>{var a=ge(),l=la(4),u=la(4);Oh(r,l,u);var m=qe[l>>2],v=qe[u>>2],E=on(m);Nn(m);var A;return v&&(A=on(v),Nn(v)),ye(a),[E,A]},Ch=r=>rm(r);M.createPreloadedFile=Xn,M.staticInit(),pf(),Mf(),G(Jn.length===10),t.noExitRuntime&&(Et=t.noExitRuntime),t.preloadPlugins&&(tn=t.preloadPlugins),t.print&&(U=t.print),t.printErr&&(I=t.printErr),t.wasmBinary&&(ee=t.wasmBinary),om(),t.arguments&&(d=t.arguments),t.thisProgram&&(f=t.thisProgram),G(typeof t.memoryInitializerPrefixURL>"u","Module.memoryInitializerPrefixURL option was removed, use Module.locateFile instead"),G(typeof t.pthreadMainPrefixURL>"u","Module.pthreadMainPrefixURL option was removed, use Module.locateFile instead"),G(typeof t.cdInitializerPrefixURL>"u","Module.cdInitializerPrefixURL option was removed, use Module.locateFile instead"),G(typeof t.filePackagePrefixURL>"u","Module.filePackagePrefixURL option was removed, use Module.locateFile instead"),G(typeof t.read>"u","Module.read option was removed"),G(typeof t.readAsync>"u","Module.readAsync option was removed (modify readAsync in JS)"),G(typeof t.readBinary>"u","Module.readBinary option was removed (modify readBinary in JS)"),G(typeof t.setWindowTitle>"u","Module.setWindowTitle option was removed (modify emscripten_set_window_title in JS)"),G(typeof t.TOTAL_MEMORY>"u","Module.TOTAL_MEMORY has been renamed Module.INITIAL_MEMORY"),G(typeof t.ENVIRONMENT>"u","Module.ENVIRONMENT has been deprecated. To force the environment, use the ENVIRONMENT compile-time option (for example, -sENVIRONMENT=web or -sENVIRONMENT=node)"),G(typeof t.STACK_SIZE>"u","STACK_SIZE can no longer be set at runtime.  Use -sSTACK_SIZE at link time"),G(typeof t.wasmMemory>"u","Use of `wasmMemory` detected.  Use -sIMPORTED_MEMORY to define wasmMemory externally"),G(typeof t.INITIAL_MEMORY>"u","Detected runtime INITIAL_MEMORY setting.  Use -sIMPORTED_MEMORY to define wasmMemory dynamically"),t.addRunDependency=ve,t.removeRunDependency=de,t.ccall=Ah,t.cwrap=Zp,t.FS_createPreloadedFile=Xn,t.FS_unlink=Qp,t.FS_createPath=Kp,t.FS_createDevice=tm,t.FS=M,t.FS_createDataFile=qt,t.FS_createLazyFile=em,t.MEMFS=ke;var sm=["writeI53ToI64","writeI53ToI64Clamped","writeI53ToI64Signaling","writeI53ToU64Clamped","writeI53ToU64Signaling","readI53FromI64","readI53FromU64","convertI32PairToI53","convertI32PairToI53Checked","convertU32PairToI53","getTempRet0","zeroMemory","withStackSave","inetPton4","inetNtop4","inetPton6","inetNtop6","readSockaddr","writeSockaddr","emscriptenLog","runMainThreadEmAsm","jstoi_q","autoResumeAudioContext","getDynCaller","dynCall","handleException","runtimeKeepalivePush","runtimeKeepalivePop","callUserCallback","maybeExit","asmjsMangle","HandleAllocator","getNativeTypeSize","addOnInit","addOnPostCtor","addOnPreMain","addOnExit","STACK_SIZE","STACK_ALIGN","POINTER_SIZE","ASSERTIONS","uleb128Encode","sigToWasmTypes","generateFuncType","convertJsFunctionToWasm","getEmptyTableSlot","updateTableMap","getFunctionAddress","addFunction","removeFunction","reallyNegative","unSign","strLen","reSign","formatString","intArrayToString","stringToAscii","stringToNewUTF8","registerKeyEventCallback","maybeCStringToJsString","findEventTarget","getBoundingClientRect","fillMouseEventData","registerMouseEventCallback","registerWheelEventCallback","registerUiEventCallback","registerFocusEventCallback","fillDeviceOrientationEventData","registerDeviceOrientationEventCallback","fillDeviceMotionEventData","registerDeviceMotionEventCallback","screenOrientation","fillOrientationChangeEventData","registerOrientationChangeEventCallback","fillFullscreenChangeEventData","registerFullscreenChangeEventCallback","JSEvents_requestFullscreen","JSEvents_resizeCanvasForFullscreen","registerRestoreOldStyle","hideEverythingExceptGivenElement","restoreHiddenElements","setLetterbox","softFullscreenResizeWebGLRenderTarget","doRequestFullscreen","fillPointerlockChangeEventData","registerPointerlockChangeEventCallback","registerPointerlockErrorEventCallback","requestPointerLock","fillVisibilityChangeEventData","registerVisibilityChangeEventCallback","registerTouchEventCallback","fillGamepadEventData","registerGamepadEventCallback","registerBeforeUnloadEventCallback","fillBatteryEventData","battery","registerBatteryEventCallback","setCanvasElementSize","getCanvasElementSize","jsStackTrace","getCallstack","convertPCtoSourceLocation","wasiRightsToMuslOFlags","wasiOFlagsToMuslOFlags","safeSetTimeout","setImmediateWrapped","safeRequestAnimationFrame","clearImmediateWrapped","registerPostMainLoop","registerPreMainLoop","getPromise","makePromise","idsToPromises","makePromiseCallback","Browser_asyncPrepareDataCounter","arraySum","addDays","getSocketFromFD","getSocketAddress","FS_mkdirTree","_setNetworkCallback","heapObjectForWebGLType","toTypedArrayIndex","webgl_enable_ANGLE_instanced_arrays","webgl_enable_OES_vertex_array_object","webgl_enable_WEBGL_draw_buffers","webgl_enable_WEBGL_multi_draw","webgl_enable_EXT_polygon_offset_clamp","webgl_enable_EXT_clip_control","webgl_enable_WEBGL_polygon_mode","emscriptenWebGLGet","computeUnpackAlignedImageSize","colorChannelsInGlTextureFormat","emscriptenWebGLGetTexPixelData","emscriptenWebGLGetUniform","webglGetUniformLocation","webglPrepareUniformLocationsBeforeFirstUse","webglGetLeftBracePos","emscriptenWebGLGetVertexAttrib","__glGetActiveAttribOrUniform","writeGLArray","registerWebGlEventCallback","runAndAbortIfError","ALLOC_NORMAL","ALLOC_STACK","allocate","writeStringToMemory","writeAsciiToMemory","demangle","stackTrace","getFunctionArgsName","createJsInvokerSignature","PureVirtualError","registerInheritedInstance","unregisterInheritedInstance","getInheritedInstanceCount","getLiveInheritedInstances","setDelayFunction","count_emval_handles"];sm.forEach(et);var am=["run","out","err","callMain","abort","wasmMemory","wasmExports","HEAPF32","HEAPF64","HEAP8","HEAPU8","HEAP16","HEAPU16","HEAP32","HEAPU32","HEAP64","HEAPU64","writeStackCookie","checkStackCookie","INT53_MAX","INT53_MIN","bigintToI53Checked","stackSave","stackRestore","stackAlloc","setTempRet0","ptrToString","exitJS","getHeapMax","growMemory","ENV","ERRNO_CODES","strError","DNS","Protocols","Sockets","timers","warnOnce","readEmAsmArgsArray","readEmAsmArgs","runEmAsmFunction","getExecutableName","keepRuntimeAlive","asyncLoad","alignMemory","mmapAlloc","wasmTable","getUniqueRunDependency","noExitRuntime","addOnPreRun","addOnPostRun","freeTableIndexes","functionsInTableMap","setValue","getValue","PATH","PATH_FS","UTF8Decoder","UTF8ArrayToString","UTF8ToString","stringToUTF8Array","stringToUTF8","lengthBytesUTF8","intArrayFromString","AsciiToString","UTF16Decoder","UTF16ToString","stringToUTF16","lengthBytesUTF16","UTF32ToString","stringToUTF32","lengthBytesUTF32","stringToUTF8OnStack","writeArrayToMemory","JSEvents","specialHTMLTargets","findCanvasEventTarget","currentFullscreenStrategy","restoreOldWindowedStyle","UNWIND_CACHE","ExitStatus","getEnvStrings","checkWasiClock","doReadv","doWritev","initRandomFill","randomFill","emSetImmediate","emClearImmediate_deps","emClearImmediate","promiseMap","uncaughtExceptionCount","exceptionLast","exceptionCaught","ExceptionInfo","findMatchingCatch","getExceptionMessageCommon","Browser","requestFullscreen","requestFullScreen","setCanvasSize","getUserMedia","createContext","getPreloadedImageData__data","wget","MONTH_DAYS_REGULAR","MONTH_DAYS_LEAP","MONTH_DAYS_REGULAR_CUMULATIVE","MONTH_DAYS_LEAP_CUMULATIVE","isLeapYear","ydayFromDate","SYSCALLS","preloadPlugins","FS_modeStringToFlags","FS_getMode","FS_stdin_getChar_buffer","FS_stdin_getChar","FS_readFile","FS_root","FS_mounts","FS_devices","FS_streams","FS_nextInode","FS_nameTable","FS_currentPath","FS_initialized","FS_ignorePermissions","FS_filesystems","FS_syncFSRequests","FS_readFiles","FS_lookupPath","FS_getPath","FS_hashName","FS_hashAddNode","FS_hashRemoveNode","FS_lookupNode","FS_createNode","FS_destroyNode","FS_isRoot","FS_isMountpoint","FS_isFile","FS_isDir","FS_isLink","FS_isChrdev","FS_isBlkdev","FS_isFIFO","FS_isSocket","FS_flagsToPermissionString","FS_nodePermissions","FS_mayLookup","FS_mayCreate","FS_mayDelete","FS_mayOpen","FS_checkOpExists","FS_nextfd","FS_getStreamChecked","FS_getStream","FS_createStream","FS_closeStream","FS_dupStream","FS_doSetAttr","FS_chrdev_stream_ops","FS_major","FS_minor","FS_makedev","FS_registerDevice","FS_getDevice","FS_getMounts","FS_syncfs","FS_mount","FS_unmount","FS_lookup","FS_mknod","FS_statfs","FS_statfsStream","FS_statfsNode","FS_create","FS_mkdir","FS_mkdev","FS_symlink","FS_rename","FS_rmdir","FS_readdir","FS_readlink","FS_stat","FS_fstat","FS_lstat","FS_doChmod","FS_chmod","FS_lchmod","FS_fchmod","FS_doChown","FS_chown","FS_lchown","FS_fchown","FS_doTruncate","FS_truncate","FS_ftruncate","FS_utime","FS_open","FS_close","FS_isClosed","FS_llseek","FS_read","FS_write","FS_mmap","FS_msync","FS_ioctl","FS_writeFile","FS_cwd","FS_chdir","FS_createDefaultDirectories","FS_createDefaultDevices","FS_createSpecialDirectories","FS_createStandardStreams","FS_staticInit","FS_init","FS_quit","FS_findObject","FS_analyzePath","FS_createFile","FS_forceLoadFile","FS_absolutePath","FS_createFolder","FS_createLink","FS_joinPath","FS_mmapAlloc","FS_standardizePath","TTY","PIPEFS","SOCKFS","tempFixedLengthArray","miniTempWebGLFloatBuffers","miniTempWebGLIntBuffers","GL","AL","GLUT","EGL","GLEW","IDBStore","SDL","SDL_gfx","allocateUTF8","allocateUTF8OnStack","print","printErr","jstoi_s","InternalError","BindingError","throwInternalError","throwBindingError","registeredTypes","awaitingDependencies","typeDependencies","tupleRegistrations","structRegistrations","sharedRegisterType","whenDependentTypesAreResolved","getTypeName","getFunctionName","heap32VectorToArray","requireRegisteredType","usesDestructorStack","checkArgCount","getRequiredArgCount","createJsInvoker","UnboundTypeError","GenericWireTypeSize","EmValType","EmValOptionalType","throwUnboundTypeError","ensureOverloadTable","exposePublicSymbol","replacePublicSymbol","createNamedFunction","embindRepr","registeredInstances","getBasestPointer","getInheritedInstance","registeredPointers","registerType","integerReadValueFromPointer","enumReadValueFromPointer","floatReadValueFromPointer","assertIntegerRange","readPointer","runDestructors","craftInvokerFunction","embind__requireFunction","genericPointerToWireType","constNoSmartPtrRawPointerToWireType","nonConstNoSmartPtrRawPointerToWireType","init_RegisteredPointer","RegisteredPointer","RegisteredPointer_fromWireType","runDestructor","releaseClassHandle","finalizationRegistry","detachFinalizer_deps","detachFinalizer","attachFinalizer","makeClassHandle","init_ClassHandle","ClassHandle","throwInstanceAlreadyDeleted","deletionQueue","flushPendingDeletes","delayFunction","RegisteredClass","shallowCopyInternalPointer","downcastPointer","upcastPointer","validateThis","char_0","char_9","makeLegalFunctionName","emval_freelist","emval_handles","emval_symbols","getStringOrSymbol","Emval","emval_get_global","emval_returnValue","emval_lookupTypes","emval_methodCallers","emval_addMethodCaller"];am.forEach(wt),t.incrementExceptionRefcount=nm,t.decrementExceptionRefcount=im,t.getExceptionMessage=Ch;function om(){je("fetchSettings")}var Rh={679512:()=>{typeof t<"u"&&"mjDISABLESTRING mjENABLESTRING mjFRAMESTRING mjLABELSTRING mjRNDSTRING mjTIMERSTRING mjVISSTRING".split(" ").forEach(function(r){Object.defineProperty(t,r,{get:function(){return t["get_"+r]()},set:function(a){},enumerable:!0,configurable:!0})})}},Ph=Pe("___getTypeName"),Tl=Pe("_malloc"),lm=Pe("___cxa_free_exception"),Al=Pe("_fflush"),Nn=Pe("_free"),Cl=Pe("_emscripten_stack_get_end"),cm=Pe("_emscripten_stack_get_base"),Ih=Pe("_strerror"),xe=Pe("_setThrew"),Lh=Pe("__emscripten_tempret_set"),Dh=Pe("_emscripten_stack_init"),hm=Pe("_emscripten_stack_get_free"),Fh=Pe("__emscripten_stack_restore"),Nh=Pe("__emscripten_stack_alloc"),Uh=Pe("_emscripten_stack_get_current"),Rl=Pe("___cxa_decrement_exception_refcount"),ca=Pe("___cxa_increment_exception_refcount"),Oh=Pe("___get_exception_message"),Bh=Pe("___cxa_can_catch"),kh=Pe("___cxa_get_exception_ptr");function um(r){Ph=Me("__getTypeName",1),Tl=Me("malloc",1),lm=Me("__cxa_free_exception",1),Al=Me("fflush",1),Nn=Me("free",1),Cl=r.emscripten_stack_get_end,cm=r.emscripten_stack_get_base,Ih=Me("strerror",1),xe=Me("setThrew",2),Lh=Me("_emscripten_tempret_set",1),Dh=r.emscripten_stack_init,hm=r.emscripten_stack_get_free,Fh=r._emscripten_stack_restore,Nh=r._emscripten_stack_alloc,Uh=r.emscripten_stack_get_current,Rl=Me("__cxa_decrement_exception_refcount",1),ca=Me("__cxa_increment_exception_refcount",1),Oh=Me("__get_exception_message",3),Bh=Me("__cxa_can_catch",3),kh=Me("__cxa_get_exception_ptr",1)}var zh={__assert_fail:jr,__cxa_begin_catch:cr,__cxa_current_primary_exception:Xs,__cxa_end_catch:Gi,__cxa_find_matching_catch_2:fl,__cxa_find_matching_catch_3:pl,__cxa_find_matching_catch_4:ml,__cxa_rethrow:Jr,__cxa_rethrow_primary_exception:C,__cxa_throw:V,__cxa_uncaught_exceptions:te,__resumeException:Z,__syscall_dup3:Mn,__syscall_fcntl64:Dn,__syscall_fstat64:$s,__syscall_ioctl:Zd,__syscall_lstat64:Kd,__syscall_newfstatat:Qd,__syscall_openat:ef,__syscall_stat64:tf,_abort_js:nf,_embind_register_bigint:sf,_embind_register_bool:af,_embind_register_class:wf,_embind_register_class_class_function:Cf,_embind_register_class_constructor:Rf,_embind_register_class_function:Pf,_embind_register_class_property:If,_embind_register_constant:Lf,_embind_register_emval:_h,_embind_register_enum:Ff,_embind_register_enum_value:Nf,_embind_register_float:Of,_embind_register_function:Bf,_embind_register_integer:kf,_embind_register_memory_view:zf,_embind_register_optional:Vf,_embind_register_std_string:Hf,_embind_register_std_wstring:Jf,_embind_register_user_type:Zf,_embind_register_void:Kf,_emscripten_throw_longjmp:Qf,_emval_as:ep,_emval_call:tp,_emval_call_method:ip,_emval_decref:Ml,_emval_get_global:rp,_emval_get_method_caller:op,_emval_get_property:lp,_emval_incref:cp,_emval_is_number:hp,_emval_is_string:up,_emval_new_array:dp,_emval_new_cstring:fp,_emval_run_destructors:pp,_emval_take_value:mp,_emval_throw:gp,_localtime_js:Mp,_mktime_js:bp,_tzset_js:wp,clock_time_get:Ap,emscripten_asm_const_int:Pp,emscripten_date_now:bh,emscripten_get_heap_max:Ip,emscripten_get_now:Mh,emscripten_resize_heap:Fp,environ_get:Up,environ_sizes_get:Op,exit:zp,fd_close:Gp,fd_read:Hp,fd_seek:Wp,fd_write:$p,invoke_ddd:Bg,invoke_dddi:tg,invoke_dddidi:ng,invoke_ddidi:eg,invoke_di:ig,invoke_dii:Xm,invoke_diii:Em,invoke_diiii:Qm,invoke_diiiidd:Zm,invoke_diiiidi:Cm,invoke_diiiii:xm,invoke_diiiiii:Fm,invoke_diiiiiii:rg,invoke_diiiiiiiii:Lm,invoke_diiiiiiiiiiii:Dm,invoke_fiii:jg,invoke_i:Sm,invoke_id:bg,invoke_ii:pm,invoke_iid:pg,invoke_iidddd:Hg,invoke_iidiii:Vm,invoke_iidiiid:zm,invoke_iidiiiiidi:Hm,invoke_iif:Vg,invoke_iii:dm,invoke_iiid:Wm,invoke_iiididdddddd:Gm,invoke_iiidiiiiiiii:km,invoke_iiii:_m,invoke_iiiidddiiiii:ag,invoke_iiiii:wm,invoke_iiiiid:Eg,invoke_iiiiii:yg,invoke_iiiiiii:gg,invoke_iiiiiiii:fg,invoke_iiiiiiiidd:Tg,invoke_iiiiiiiii:Jm,invoke_iiiiiiiiii:_g,invoke_iiiiiiiiiidddiiiiiiiii:Bm,invoke_iiiiiiiiiii:Yg,invoke_iiiiiiiiiiii:Jg,invoke_iiiiiiiiiiiii:Ig,invoke_iiij:vg,invoke_iiji:wg,invoke_j:$g,invoke_ji:Ug,invoke_jiiii:xg,invoke_jij:Og,invoke_v:gm,invoke_vi:mm,invoke_vid:mg,invoke_viddd:Sg,invoke_vidddd:Mg,invoke_vidi:Km,invoke_vidiii:Um,invoke_vii:ym,invoke_viid:Ym,invoke_viiddi:Pg,invoke_viiddidi:Rg,invoke_viiddii:sg,invoke_viidi:qm,invoke_viidii:Am,invoke_viidiii:ug,invoke_viidiiid:cg,invoke_viidiiiii:Om,invoke_viidiiiiidi:dg,invoke_viidiiiiiiii:Nm,invoke_viii:fm,invoke_viiid:Pm,invoke_viiidd:Cg,invoke_viiidi:$m,invoke_viiididdddddd:hg,invoke_viiidiiiiiiii:lg,invoke_viiii:bm,invoke_viiiiddd:Ag,invoke_viiiidi:kg,invoke_viiiifi:zg,invoke_viiiii:vm,invoke_viiiiid:Rm,invoke_viiiiii:Mm,invoke_viiiiiii:Tm,invoke_viiiiiiii:jm,invoke_viiiiiiiiii:Fg,invoke_viiiiiiiiiidddiiiiiiiii:og,invoke_viiiiiiiiiiid:Im,invoke_viiiiiiiiiiiii:Dg,invoke_viiiiiiiiiiiiiii:Zg,invoke_viiiiiiiiiiiiiiiiii:Ng,invoke_viiiij:Wg,invoke_viij:Xg,invoke_viijii:qg,invoke_vij:Gg,invoke_vijjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjj:Lg,llvm_eh_typeid_for:qp},qi=await Ee();function dm(r,a,l){var u=ge();try{return be(r)(a,l)}catch(m){if(ye(u),!(m instanceof H))throw m;xe(1,0)}}function fm(r,a,l,u){var m=ge();try{be(r)(a,l,u)}catch(v){if(ye(m),!(v instanceof H))throw v;xe(1,0)}}function pm(r,a){var l=ge();try{return be(r)(a)}catch(u){if(ye(l),!(u instanceof H))throw u;xe(1,0)}}function mm(r,a){var l=ge();try{be(r)(a)}catch(u){if(ye(l),!(u instanceof H))throw u;xe(1,0)}}function gm(r){var a=ge();try{be(r)()}catch(l){if(ye(a),!(l instanceof H))throw l;xe(1,0)}}function _m(r,a,l,u){var m=ge();try{return be(r)(a,l,u)}catch(v){if(ye(m),!(v instanceof H))throw v;xe(1,0)}}function vm(r,a,l,u,m,v){var E=ge();try{be(r)(a,l,u,m,v)}catch(A){if(ye(E),!(A instanceof H))throw A;xe(1,0)}}function ym(r,a,l){var u=ge();try{be(r)(a,l)}catch(m){if(ye(u),!(m instanceof H))throw m;xe(1,0)}}function xm(r,a,l,u,m,v){var E=ge();try{return be(r)(a,l,u,m,v)}catch(A){if(ye(E),!(A instanceof H))throw A;xe(1,0)}}function Sm(r){var a=ge();try{return be(r)()}catch(l){if(ye(a),!(l instanceof H))throw l;xe(1,0)}}function Mm(r,a,l,u,m,v,E){var A=ge();try{be(r)(a,l,u,m,v,E)}catch(F){if(ye(A),!(F instanceof H))throw F;xe(1,0)}}function bm(r,a,l,u,m){var v=ge();try{be(r)(a,l,u,m)}catch(E){if(ye(v),!(E instanceof H))throw E;xe(1,0)}}function wm(r,a,l,u,m){var v=ge();try{return be(r)(a,l,u,m)}catch(E){if(ye(v),!(E instanceof H))throw E;xe(1,0)}}function Em(r,a,l,u){var m=ge();try{return be(r)(a,l,u)}catch(v){if(ye(m),!(v instanceof H))throw v;xe(1,0)}}function Tm(r,a,l,u,m,v,E,A){var F=ge();try{be(r)(a,l,u,m,v,E,A)}catch(X){if(ye(F),!(X instanceof H))throw X;xe(1,0)}}function Am(r,a,l,u,m,v){var E=ge();try{be(r)(a,l,u,m,v)}catch(A){if(ye(E),!(A instanceof H))throw A;xe(1,0)}}function Cm(r,a,l,u,m,v,E){var A=ge();try{return be(r)(a,l,u,m,v,E)}catch(F){if(ye(A),!(F instanceof H))throw F;xe(1,0)}}function Rm(r,a,l,u,m,v,E){var A=ge();try{be(r)(a,l,u,m,v,E)}catch(F){if(ye(A),!(F instanceof H))throw F;xe(1,0)}}function Pm(r,a,l,u,m){var v=ge();try{be(r)(a,l,u,m)}catch(E){if(ye(v),!(E instanceof H))throw E;xe(1,0)}}function Im(r,a,l,u,m,v,E,A,F,X,K,oe,fe){var ce=ge();try{be(r)(a,l,u,m,v,E,A,F,X,K,oe,fe)}catch(_e){if(ye(ce),!(_e instanceof H))throw _e;xe(1,0)}}function Lm(r,a,l,u,m,v,E,A,F,X){var K=ge();try{return be(r)(a,l,u,m,v,E,A,F,X)}catch(oe){if(ye(K),!(oe instanceof H))throw oe;xe(1,0)}}function Dm(r,a,l,u,m,v,E,A,F,X,K,oe,fe){var ce=ge();try{return be(r)(a,l,u,m,v,E,A,F,X,K,oe,fe)}catch(_e){if(ye(ce),!(_e instanceof H))throw _e;xe(1,0)}}function Fm(r,a,l,u,m,v,E){var A=ge();try{return be(r)(a,l,u,m,v,E)}catch(F){if(ye(A),!(F instanceof H))throw F;xe(1,0)}}function Nm(r,a,l,u,m,v,E,A,F,X,K,oe){var fe=ge();try{be(r)(a,l,u,m,v,E,A,F,X,K,oe)}catch(ce){if(ye(fe),!(ce instanceof H))throw ce;xe(1,0)}}function Um(r,a,l,u,m,v){var E=ge();try{be(r)(a,l,u,m,v)}catch(A){if(ye(E),!(A instanceof H))throw A;xe(1,0)}}function Om(r,a,l,u,m,v,E,A,F){var X=ge();try{be(r)(a,l,u,m,v,E,A,F)}catch(K){if(ye(X),!(K instanceof H))throw K;xe(1,0)}}function Bm(r,a,l,u,m,v,E,A,F,X,K,oe,fe,ce,_e,Ke,vt,pt,Ut,bt,cn,Jt){var pn=ge();try{return be(r)(a,l,u,m,v,E,A,F,X,K,oe,fe,ce,_e,Ke,vt,pt,Ut,bt,cn,Jt)}catch(Ft){if(ye(pn),!(Ft instanceof H))throw Ft;xe(1,0)}}function km(r,a,l,u,m,v,E,A,F,X,K,oe){var fe=ge();try{return be(r)(a,l,u,m,v,E,A,F,X,K,oe)}catch(ce){if(ye(fe),!(ce instanceof H))throw ce;xe(1,0)}}function zm(r,a,l,u,m,v,E){var A=ge();try{return be(r)(a,l,u,m,v,E)}catch(F){if(ye(A),!(F instanceof H))throw F;xe(1,0)}}function Gm(r,a,l,u,m,v,E,A,F,X,K,oe){var fe=ge();try{return be(r)(a,l,u,m,v,E,A,F,X,K,oe)}catch(ce){if(ye(fe),!(ce instanceof H))throw ce;xe(1,0)}}function Vm(r,a,l,u,m,v){var E=ge();try{return be(r)(a,l,u,m,v)}catch(A){if(ye(E),!(A instanceof H))throw A;xe(1,0)}}function Hm(r,a,l,u,m,v,E,A,F,X){var K=ge();try{return be(r)(a,l,u,m,v,E,A,F,X)}catch(oe){if(ye(K),!(oe instanceof H))throw oe;xe(1,0)}}function Wm(r,a,l,u){var m=ge();try{return be(r)(a,l,u)}catch(v){if(ye(m),!(v instanceof H))throw v;xe(1,0)}}function Xm(r,a,l){var u=ge();try{return be(r)(a,l)}catch(m){if(ye(u),!(m instanceof H))throw m;xe(1,0)}}function $m(r,a,l,u,m,v){var E=ge();try{be(r)(a,l,u,m,v)}catch(A){if(ye(E),!(A instanceof H))throw A;xe(1,0)}}function qm(r,a,l,u,m){var v=ge();try{be(r)(a,l,u,m)}catch(E){if(ye(v),!(E instanceof H))throw E;xe(1,0)}}function Ym(r,a,l,u){var m=ge();try{be(r)(a,l,u)}catch(v){if(ye(m),!(v instanceof H))throw v;xe(1,0)}}function jm(r,a,l,u,m,v,E,A,F){var X=ge();try{be(r)(a,l,u,m,v,E,A,F)}catch(K){if(ye(X),!(K instanceof H))throw K;xe(1,0)}}function Jm(r,a,l,u,m,v,E,A,F){var X=ge();try{return be(r)(a,l,u,m,v,E,A,F)}catch(K){if(ye(X),!(K instanceof H))throw K;xe(1,0)}}function Zm(r,a,l,u,m,v,E){var A=ge();try{return be(r)(a,l,u,m,v,E)}catch(F){if(ye(A),!(F instanceof H))throw F;xe(1,0)}}function Km(r,a,l,u){var m=ge();try{be(r)(a,l,u)}catch(v){if(ye(m),!(v instanceof H))throw v;xe(1,0)}}function Qm(r,a,l,u,m){var v=ge();try{return be(r)(a,l,u,m)}catch(E){if(ye(v),!(E instanceof H))throw E;xe(1,0)}}function eg(r,a,l,u,m){var v=ge();try{return be(r)(a,l,u,m)}catch(E){if(ye(v),!(E instanceof H))throw E;xe(1,0)}}function tg(r,a,l,u){var m=ge();try{return be(r)(a,l,u)}catch(v){if(ye(m),!(v instanceof H))throw v;xe(1,0)}}function ng(r,a,l,u,m,v){var E=ge();try{return be(r)(a,l,u,m,v)}catch(A){if(ye(E),!(A instanceof H))throw A;xe(1,0)}}function ig(r,a){var l=ge();try{return be(r)(a)}catch(u){if(ye(l),!(u instanceof H))throw u;xe(1,0)}}function rg(r,a,l,u,m,v,E,A){var F=ge();try{return be(r)(a,l,u,m,v,E,A)}catch(X){if(ye(F),!(X instanceof H))throw X;xe(1,0)}}function sg(r,a,l,u,m,v,E){var A=ge();try{be(r)(a,l,u,m,v,E)}catch(F){if(ye(A),!(F instanceof H))throw F;xe(1,0)}}function ag(r,a,l,u,m,v,E,A,F,X,K,oe){var fe=ge();try{return be(r)(a,l,u,m,v,E,A,F,X,K,oe)}catch(ce){if(ye(fe),!(ce instanceof H))throw ce;xe(1,0)}}function og(r,a,l,u,m,v,E,A,F,X,K,oe,fe,ce,_e,Ke,vt,pt,Ut,bt,cn,Jt,pn){var Ft=ge();try{be(r)(a,l,u,m,v,E,A,F,X,K,oe,fe,ce,_e,Ke,vt,pt,Ut,bt,cn,Jt,pn)}catch(Yi){if(ye(Ft),!(Yi instanceof H))throw Yi;xe(1,0)}}function lg(r,a,l,u,m,v,E,A,F,X,K,oe,fe){var ce=ge();try{be(r)(a,l,u,m,v,E,A,F,X,K,oe,fe)}catch(_e){if(ye(ce),!(_e instanceof H))throw _e;xe(1,0)}}function cg(r,a,l,u,m,v,E,A){var F=ge();try{be(r)(a,l,u,m,v,E,A)}catch(X){if(ye(F),!(X instanceof H))throw X;xe(1,0)}}function hg(r,a,l,u,m,v,E,A,F,X,K,oe,fe){var ce=ge();try{be(r)(a,l,u,m,v,E,A,F,X,K,oe,fe)}catch(_e){if(ye(ce),!(_e instanceof H))throw _e;xe(1,0)}}function ug(r,a,l,u,m,v,E){var A=ge();try{be(r)(a,l,u,m,v,E)}catch(F){if(ye(A),!(F instanceof H))throw F;xe(1,0)}}function dg(r,a,l,u,m,v,E,A,F,X,K){var oe=ge();try{be(r)(a,l,u,m,v,E,A,F,X,K)}catch(fe){if(ye(oe),!(fe instanceof H))throw fe;xe(1,0)}}function fg(r,a,l,u,m,v,E,A){var F=ge();try{return be(r)(a,l,u,m,v,E,A)}catch(X){if(ye(F),!(X instanceof H))throw X;xe(1,0)}}function pg(r,a,l){var u=ge();try{return be(r)(a,l)}catch(m){if(ye(u),!(m instanceof H))throw m;xe(1,0)}}function mg(r,a,l){var u=ge();try{be(r)(a,l)}catch(m){if(ye(u),!(m instanceof H))throw m;xe(1,0)}}function gg(r,a,l,u,m,v,E){var A=ge();try{return be(r)(a,l,u,m,v,E)}catch(F){if(ye(A),!(F instanceof H))throw F;xe(1,0)}}function _g(r,a,l,u,m,v,E,A,F,X){var K=ge();try{return be(r)(a,l,u,m,v,E,A,F,X)}catch(oe){if(ye(K),!(oe instanceof H))throw oe;xe(1,0)}}function vg(r,a,l,u){var m=ge();try{return be(r)(a,l,u)}catch(v){if(ye(m),!(v instanceof H))throw v;xe(1,0)}}function yg(r,a,l,u,m,v){var E=ge();try{return be(r)(a,l,u,m,v)}catch(A){if(ye(E),!(A instanceof H))throw A;xe(1,0)}}function xg(r,a,l,u,m){var v=ge();try{return be(r)(a,l,u,m)}catch(E){if(ye(v),!(E instanceof H))throw E;return xe(1,0),0n}}function Sg(r,a,l,u,m){var v=ge();try{be(r)(a,l,u,m)}catch(E){if(ye(v),!(E instanceof H))throw E;xe(1,0)}}function Mg(r,a,l,u,m,v){var E=ge();try{be(r)(a,l,u,m,v)}catch(A){if(ye(E),!(A instanceof H))throw A;xe(1,0)}}function bg(r,a){var l=ge();try{return be(r)(a)}catch(u){if(ye(l),!(u instanceof H))throw u;xe(1,0)}}function wg(r,a,l,u){var m=ge();try{return be(r)(a,l,u)}catch(v){if(ye(m),!(v instanceof H))throw v;xe(1,0)}}function Eg(r,a,l,u,m,v){var E=ge();try{return be(r)(a,l,u,m,v)}catch(A){if(ye(E),!(A instanceof H))throw A;xe(1,0)}}function Tg(r,a,l,u,m,v,E,A,F,X){var K=ge();try{return be(r)(a,l,u,m,v,E,A,F,X)}catch(oe){if(ye(K),!(oe instanceof H))throw oe;xe(1,0)}}function Ag(r,a,l,u,m,v,E,A){var F=ge();try{be(r)(a,l,u,m,v,E,A)}catch(X){if(ye(F),!(X instanceof H))throw X;xe(1,0)}}function Cg(r,a,l,u,m,v){var E=ge();try{be(r)(a,l,u,m,v)}catch(A){if(ye(E),!(A instanceof H))throw A;xe(1,0)}}function Rg(r,a,l,u,m,v,E,A){var F=ge();try{be(r)(a,l,u,m,v,E,A)}catch(X){if(ye(F),!(X instanceof H))throw X;xe(1,0)}}function Pg(r,a,l,u,m,v){var E=ge();try{be(r)(a,l,u,m,v)}catch(A){if(ye(E),!(A instanceof H))throw A;xe(1,0)}}function Ig(r,a,l,u,m,v,E,A,F,X,K,oe,fe){var ce=ge();try{return be(r)(a,l,u,m,v,E,A,F,X,K,oe,fe)}catch(_e){if(ye(ce),!(_e instanceof H))throw _e;xe(1,0)}}function Lg(r,a,l,u,m,v,E,A,F,X,K,oe,fe,ce,_e,Ke,vt,pt,Ut,bt,cn,Jt,pn,Ft,Yi,t_,n_,i_,r_,s_,a_,o_,l_,c_,h_,u_,d_,f_,p_,m_,g_,__,v_,y_,x_,S_,M_,b_,w_,E_,T_,A_,C_,R_,P_,I_,L_,D_,F_,N_,U_,O_,B_,k_,z_,G_,V_,H_,W_,X_,$_,q_,Y_,j_,J_,Z_,K_,Q_,e0,t0,n0,i0,r0,s0,a0,o0){var l0=ge();try{be(r)(a,l,u,m,v,E,A,F,X,K,oe,fe,ce,_e,Ke,vt,pt,Ut,bt,cn,Jt,pn,Ft,Yi,t_,n_,i_,r_,s_,a_,o_,l_,c_,h_,u_,d_,f_,p_,m_,g_,__,v_,y_,x_,S_,M_,b_,w_,E_,T_,A_,C_,R_,P_,I_,L_,D_,F_,N_,U_,O_,B_,k_,z_,G_,V_,H_,W_,X_,$_,q_,Y_,j_,J_,Z_,K_,Q_,e0,t0,n0,i0,r0,s0,a0,o0)}catch(Vh){if(ye(l0),!(Vh instanceof H))throw Vh;xe(1,0)}}function Dg(r,a,l,u,m,v,E,A,F,X,K,oe,fe,ce){var _e=ge();try{be(r)(a,l,u,m,v,E,A,F,X,K,oe,fe,ce)}catch(Ke){if(ye(_e),!(Ke instanceof H))throw Ke;xe(1,0)}}function Fg(r,a,l,u,m,v,E,A,F,X,K){var oe=ge();try{be(r)(a,l,u,m,v,E,A,F,X,K)}catch(fe){if(ye(oe),!(fe instanceof H))throw fe;xe(1,0)}}function Ng(r,a,l,u,m,v,E,A,F,X,K,oe,fe,ce,_e,Ke,vt,pt,Ut){var bt=ge();try{be(r)(a,l,u,m,v,E,A,F,X,K,oe,fe,ce,_e,Ke,vt,pt,Ut)}catch(cn){if(ye(bt),!(cn instanceof H))throw cn;xe(1,0)}}function Ug(r,a){var l=ge();try{return be(r)(a)}catch(u){if(ye(l),!(u instanceof H))throw u;return xe(1,0),0n}}function Og(r,a,l){var u=ge();try{return be(r)(a,l)}catch(m){if(ye(u),!(m instanceof H))throw m;return xe(1,0),0n}}function Bg(r,a,l){var u=ge();try{return be(r)(a,l)}catch(m){if(ye(u),!(m instanceof H))throw m;xe(1,0)}}function kg(r,a,l,u,m,v,E){var A=ge();try{be(r)(a,l,u,m,v,E)}catch(F){if(ye(A),!(F instanceof H))throw F;xe(1,0)}}function zg(r,a,l,u,m,v,E){var A=ge();try{be(r)(a,l,u,m,v,E)}catch(F){if(ye(A),!(F instanceof H))throw F;xe(1,0)}}function Gg(r,a,l){var u=ge();try{be(r)(a,l)}catch(m){if(ye(u),!(m instanceof H))throw m;xe(1,0)}}function Vg(r,a,l){var u=ge();try{return be(r)(a,l)}catch(m){if(ye(u),!(m instanceof H))throw m;xe(1,0)}}function Hg(r,a,l,u,m,v){var E=ge();try{return be(r)(a,l,u,m,v)}catch(A){if(ye(E),!(A instanceof H))throw A;xe(1,0)}}function Wg(r,a,l,u,m,v){var E=ge();try{be(r)(a,l,u,m,v)}catch(A){if(ye(E),!(A instanceof H))throw A;xe(1,0)}}function Xg(r,a,l,u){var m=ge();try{be(r)(a,l,u)}catch(v){if(ye(m),!(v instanceof H))throw v;xe(1,0)}}function $g(r){var a=ge();try{return be(r)()}catch(l){if(ye(a),!(l instanceof H))throw l;return xe(1,0),0n}}function qg(r,a,l,u,m,v){var E=ge();try{be(r)(a,l,u,m,v)}catch(A){if(ye(E),!(A instanceof H))throw A;xe(1,0)}}function Yg(r,a,l,u,m,v,E,A,F,X,K){var oe=ge();try{return be(r)(a,l,u,m,v,E,A,F,X,K)}catch(fe){if(ye(oe),!(fe instanceof H))throw fe;xe(1,0)}}function jg(r,a,l,u){var m=ge();try{return be(r)(a,l,u)}catch(v){if(ye(m),!(v instanceof H))throw v;xe(1,0)}}function Jg(r,a,l,u,m,v,E,A,F,X,K,oe){var fe=ge();try{return be(r)(a,l,u,m,v,E,A,F,X,K,oe)}catch(ce){if(ye(fe),!(ce instanceof H))throw ce;xe(1,0)}}function Zg(r,a,l,u,m,v,E,A,F,X,K,oe,fe,ce,_e,Ke){var vt=ge();try{be(r)(a,l,u,m,v,E,A,F,X,K,oe,fe,ce,_e,Ke)}catch(pt){if(ye(vt),!(pt instanceof H))throw pt;xe(1,0)}}var Gh;function Kg(){Dh(),Se()}function Pl(){if(Ze>0){D=Pl;return}if(Kg(),De(),Ze>0){D=Pl;return}function r(){G(!Gh),Gh=!0,t.calledRun=!0,!z&&(Xt(),Tt?.(t),t.onRuntimeInitialized?.(),Fe("onRuntimeInitialized"),G(!t._main,'compiled without a main, but one is present. if you added it from JS, use Module["onRuntimeInitialized"]'),Je())}t.setStatus?(t.setStatus("Running..."),setTimeout(()=>{setTimeout(()=>t.setStatus(""),1),r()},1)):r(),re()}function Qg(){var r=U,a=I,l=!1;U=I=u=>{l=!0};try{Al(0),["stdout","stderr"].forEach(u=>{var m=M.analyzePath("/dev/"+u);if(m){var v=m.object,E=v.rdev,A=st.ttys[E];A?.output?.length&&(l=!0)}})}catch{}U=r,I=a,l&&Wn("stdio streams had content in them that was not flushed. you should set EXIT_RUNTIME to 1 (see the Emscripten FAQ), or make sure to emit a newline when you printf etc.")}function e_(){if(t.preInit)for(typeof t.preInit=="function"&&(t.preInit=[t.preInit]);t.preInit.length>0;)t.preInit.shift()();Fe("preInit")}e_(),Pl(),At?e=t:e=new Promise((r,a)=>{Tt=r,dt=a});for(let r of Object.keys(t))r in i||Object.defineProperty(i,r,{configurable:!0,get(){pe(`Access to module property ('${r}') is no longer possible via the module constructor argument; Instead, use the result of the module constructor.`)}});return e}),Hh=c0;var[Il,fr]=[200,92],Zn={left:34,right:56,top:8,bottom:16},ha=["#2f5d8a","#b4432f","#2f7d4f","#8a6a1f","#6b4a86","#40535e"],h0=11,wi=(i,e,t="")=>{let n=document.createElementNS("http://www.w3.org/2000/svg",i);for(let[s,o]of Object.entries(e))n.setAttribute(s,o);return n.textContent=t,n};function Wh(i,e){return Object.keys(i.readings).filter(t=>{let{names:n,components:s}=i.readings[t],o=e.some(c=>c[t].some(h=>![-1,0,1].includes(h)));return e.length>1&&o&&n.length*s.length<=ha.length})}function u0(i){let e=[...i.keys()].sort((s,o)=>i[s]-i[o]),t=[...i];e.forEach((s,o)=>{o&&(t[s]=Math.max(t[s],t[e[o-1]]+h0))});let n=Math.max(0,t[e.at(-1)]-(fr-Zn.bottom));return t.map(s=>s-n)}function Xh(i,{names:e,components:t,unit:n},s,o){let c=s.flat(),[h,d]=[Math.min(0,...c),Math.max(0,...c)],f=R=>Zn.left+R/Math.max(1,s.length-1)*(Il-Zn.left-Zn.right),p=R=>fr-Zn.bottom-(R-h)/(d-h)*(fr-Zn.top-Zn.bottom),_=wi("svg",{viewBox:`0 0 ${Il} ${fr}`,class:"plot",role:"img","aria-label":`${i} by move`}),g=[Il-Zn.right,Zn.left];for(let R of new Set([h,0,d]))_.append(wi("line",{x1:g[0],x2:g[1],y1:p(R),y2:p(R)})),_.append(wi("text",{x:Zn.left-4,y:p(R)+3,"text-anchor":"end"},o(R)));_.append(wi("text",{x:f(0),y:fr-4},"0")),_.append(wi("text",{x:f(s.length-1),y:fr-4,"text-anchor":"end"},`move ${s.length-1}`));let S=e.flatMap(R=>t.map(x=>`${R} ${x}`.trim())),w=u0(S.map((R,x)=>p(s.at(-1)[x])));return S.forEach((R,x)=>{let y=s.map((P,U)=>`${f(U)},${p(P[x])}`).join(" ");_.append(wi("polyline",{points:y,stroke:ha[x],fill:"none"})),s.forEach((P,U)=>_.append(wi("circle",{cx:f(U),cy:p(P[x]),r:2,fill:ha[x]}))),S.length>1&&_.append(wi("text",{x:g[0]+4,y:w[x]+3,fill:ha[x]},R))}),_}var[es,$h]=[.012,.035],d0=.004;function f0(i){let e=10**Math.floor(Math.log10(i/8)),t=e*[1,2,5,10].find(n=>i/(n*e)<=8);return i<2?t:Math.max(1,t)}var qh=([i,e],t)=>{let n=Math.ceil(i/t);return Array.from({length:Math.floor(e/t)-n+1},(s,o)=>(n+o)*t)};function Yh(i,e){let{structure:t,model:n}=e;return t.indicators.flatMap(([s,o,,c],h)=>{let{names:d,components:f,limits:p}=i.readings[o];if(!(c[0]&&!c[1]&&!c[2]&&!i.sizes[h])||!p||d.length*f.length>1)return[];let[g,S]=t.start.geom_xpos.slice(3*s,3*s+2),[w]=e.read(o,t.start.sensordata),R=S-n.geom_size[3*s+1],x=(b,L)=>[g+c[0]*(b-w),R-L,d0],[[y,P]]=p,U=f0(P-y),I=qh(p[0],U),O=U>1&&P-y<=200?qh(p[0],1):[],N=(b,L)=>[x(b,es),x(b,es+L*($h-es))];return{name:o,thing:t.things[s],lines:[x(y,es),x(P,es),...I.flatMap(b=>N(b,1)),...O.flatMap(b=>N(b,.5))],numbers:I.map(b=>({value:b,at:x(b,2*$h)}))}})}var Eu=0,oc=1,Tu=2;var nr=1,Au=2,zr=3,Oi=0,yn=1,ri=2,ir=0,Gr=1,lc=2,cc=3,hc=4,Cu=5;var rr=100,Ru=101,Pu=102,Iu=103,Lu=104,Du=200,Fu=201,Nu=202,Uu=203,uc=204,dc=205,Ou=206,Bu=207,ku=208,zu=209,Gu=210,Vu=211,Hu=212,Wu=213,Xu=214,Na=0,Ua=1,Oa=2,Cr=3,Ba=4,ka=5,za=6,Ga=7,fc=0,$u=1,qu=2,si=0,pc=1,mc=2,gc=3,_c=4,vc=5,yc=6,xc=7;var Sc=300,sr=301,Vr=302,mo=303,go=304,Va=1e3,Qn=1001,Ha=1002,sn=1003,Yu=1004;var Is=1005;var _n=1006,_o=1007;var xi=1008;var Sn=1009,Mc=1010,bc=1011,Hr=1012,vo=1013,zn=1014,Gn=1015,Vn=1016,yo=1017,xo=1018,ar=1020,wc=35902,Ec=35899,Tc=1021,Ac=1022,Hn=1023,gi=1026,Si=1027,Cc=1028,So=1029,Bi=1030,Mo=1031;var bo=1033,Ls=33776,Ds=33777,Fs=33778,Ns=33779,wo=35840,Eo=35841,To=35842,Ao=35843,Co=36196,Ro=37492,Po=37496,Io=37488,Lo=37489,Us=37490,Do=37491,Fo=37808,No=37809,Uo=37810,Oo=37811,Bo=37812,ko=37813,zo=37814,Go=37815,Vo=37816,Ho=37817,Wo=37818,Xo=37819,$o=37820,qo=37821,Yo=36492,jo=36494,Jo=36495,Zo=36283,Ko=36284,Os=36285,Qo=36286;var cs=2300,Wa=2301,Da=2302,Ql=2303,ec=2400,tc=2401,nc=2402;var ju=3200;var el=0,Ju=1,Mi="",mn="srgb",hs="srgb-linear",us="linear",Ct="srgb";var Fa=7680;var Zu=519,Ku=512,Qu=513,ed=514,Rc=515,td=516,nd=517,Pc=518,Ic=519,id=35044;var Lc="300 es",In=2e3,Rr=2001;function p0(i){for(let e=i.length-1;e>=0;--e)if(i[e]>=65535)return!0;return!1}function m0(i){return ArrayBuffer.isView(i)&&!(i instanceof DataView)}function ds(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function rd(){let i=ds("canvas");return i.style.display="block",i}var jh={},Pr=null;function Dc(...i){let e="THREE."+i.shift();Pr?Pr("log",e,...i):console.log(e,...i)}function sd(i){let e=i[0];if(typeof e=="string"&&e.startsWith("TSL:")){let t=i[1];t&&t.isStackTrace?i[0]+=" "+t.getLocation():i[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return i}function Qe(...i){i=sd(i);let e="THREE."+i.shift();if(Pr)Pr("warn",e,...i);else{let t=i[0];t&&t.isStackTrace?console.warn(t.getError(e)):console.warn(e,...i)}}function tt(...i){i=sd(i);let e="THREE."+i.shift();if(Pr)Pr("error",e,...i);else{let t=i[0];t&&t.isStackTrace?console.error(t.getError(e)):console.error(e,...i)}}function as(...i){let e=i.join(" ");e in jh||(jh[e]=!0,Qe(...i))}function ad(i,e,t){return new Promise(function(n,s){function o(){switch(i.clientWaitSync(e,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(o,t);break;default:n()}}setTimeout(o,t)})}var od={[Na]:Na,[Oa]:za,[Ba]:Ba,[Cr]:ka,[Ua]:Ua,[za]:Oa,[Ga]:Ga,[ka]:Cr},ti=class{addEventListener(e,t){this._listeners===void 0&&(this._listeners={});let n=this._listeners;n[e]===void 0&&(n[e]=[]),n[e].indexOf(t)===-1&&n[e].push(t)}hasEventListener(e,t){let n=this._listeners;return n===void 0?!1:n[e]!==void 0&&n[e].indexOf(t)!==-1}removeEventListener(e,t){let n=this._listeners;if(n===void 0)return;let s=n[e];if(s!==void 0){let o=s.indexOf(t);o!==-1&&s.splice(o,1)}}dispatchEvent(e){let t=this._listeners;if(t===void 0)return;let n=t[e.type];if(n!==void 0){e.target=this;let s=n.slice(0);for(let o=0,c=s.length;o<c;o++)s[o].call(this,e);e.target=null}}},hn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],Jh=1234567,os=Math.PI/180,Ir=180/Math.PI;function Wr(){let i=Math.random()*4294967295|0,e=Math.random()*4294967295|0,t=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(hn[i&255]+hn[i>>8&255]+hn[i>>16&255]+hn[i>>24&255]+"-"+hn[e&255]+hn[e>>8&255]+"-"+hn[e>>16&15|64]+hn[e>>24&255]+"-"+hn[t&63|128]+hn[t>>8&255]+"-"+hn[t>>16&255]+hn[t>>24&255]+hn[n&255]+hn[n>>8&255]+hn[n>>16&255]+hn[n>>24&255]).toLowerCase()}function xt(i,e,t){return Math.max(e,Math.min(t,i))}function Fc(i,e){return(i%e+e)%e}function g0(i,e,t,n,s){return n+(i-e)*(s-n)/(t-e)}function _0(i,e,t){return i!==e?(t-i)/(e-i):0}function ls(i,e,t){return(1-t)*i+t*e}function v0(i,e,t,n){return ls(i,e,1-Math.exp(-t*n))}function y0(i,e=1){return e-Math.abs(Fc(i,e*2)-e)}function x0(i,e,t){return i<=e?0:i>=t?1:(i=(i-e)/(t-e),i*i*(3-2*i))}function S0(i,e,t){return i<=e?0:i>=t?1:(i=(i-e)/(t-e),i*i*i*(i*(i*6-15)+10))}function M0(i,e){return i+Math.floor(Math.random()*(e-i+1))}function b0(i,e){return i+Math.random()*(e-i)}function w0(i){return i*(.5-Math.random())}function E0(i){i!==void 0&&(Jh=i);let e=Jh+=1831565813;return e=Math.imul(e^e>>>15,e|1),e^=e+Math.imul(e^e>>>7,e|61),((e^e>>>14)>>>0)/4294967296}function T0(i){return i*os}function A0(i){return i*Ir}function C0(i){return i>0&&Number.isInteger(i)&&2**Math.round(Math.log2(i))===i}function R0(i){return Math.pow(2,Math.ceil(Math.log(i)/Math.LN2))}function Nc(i){return Math.pow(2,Math.floor(Math.log(i)/Math.LN2))}function P0(i,e,t,n,s){let o=Math.cos,c=Math.sin,h=o(t/2),d=c(t/2),f=o((e+n)/2),p=c((e+n)/2),_=o((e-n)/2),g=c((e-n)/2),S=o((n-e)/2),w=c((n-e)/2);switch(s){case"XYX":i.set(h*p,d*_,d*g,h*f);break;case"YZY":i.set(d*g,h*p,d*_,h*f);break;case"ZXZ":i.set(d*_,d*g,h*p,h*f);break;case"XZX":i.set(h*p,d*w,d*S,h*f);break;case"YXY":i.set(d*S,h*p,d*w,h*f);break;case"ZYZ":i.set(d*w,d*S,h*p,h*f);break;default:Qe("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function Uc(i){switch(i.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function ld(i,e){if(e.constructor===Float32Array)return i;let t=Uc(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(i/t,-1)}function cd(i,e){if(e.constructor===Float32Array)return i;let t=Uc(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(i*t)}var tl={DEG2RAD:os,RAD2DEG:Ir,generateUUID:Wr,clamp:xt,euclideanModulo:Fc,mapLinear:g0,inverseLerp:_0,lerp:ls,damp:v0,pingpong:y0,smoothstep:x0,smootherstep:S0,randInt:M0,randFloat:b0,randFloatSpread:w0,seededRandom:E0,degToRad:T0,radToDeg:A0,isPowerOfTwo:C0,ceilPowerOfTwo:R0,floorPowerOfTwo:Nc,setQuaternionFromProperEuler:P0,normalize:cd,denormalize:ld},gt=class{static{this.prototype.isVector2=!0}constructor(e=0,t=0){this.x=e,this.y=t}get width(){return this.x}set width(e){this.x=e}get height(){return this.y}set height(e){this.y=e}set(e,t){return this.x=e,this.y=t,this}setScalar(e){return this.x=e,this.y=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;default:throw new Error("THREE.Vector2: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y)}copy(e){return this.x=e.x,this.y=e.y,this}add(e){return this.x+=e.x,this.y+=e.y,this}addScalar(e){return this.x+=e,this.y+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this}subScalar(e){return this.x-=e,this.y-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this}multiply(e){return this.x*=e.x,this.y*=e.y,this}multiplyScalar(e){return this.x*=e,this.y*=e,this}divide(e){return this.x/=e.x,this.y/=e.y,this}divideScalar(e){return this.multiplyScalar(1/e)}applyMatrix3(e){let t=this.x,n=this.y,s=e.elements;return this.x=s[0]*t+s[3]*n+s[6],this.y=s[1]*t+s[4]*n+s[7],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this}clamp(e,t){return this.x=xt(this.x,e.x,t.x),this.y=xt(this.y,e.y,t.y),this}clampScalar(e,t){return this.x=xt(this.x,e,t),this.y=xt(this.y,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(xt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(e){return this.x*e.x+this.y*e.y}cross(e){return this.x*e.y-this.y*e.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(xt(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y;return t*t+n*n}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this}equals(e){return e.x===this.x&&e.y===this.y}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this}rotateAround(e,t){let n=Math.cos(t),s=Math.sin(t),o=this.x-e.x,c=this.y-e.y;return this.x=o*n-c*s+e.x,this.y=o*s+c*n+e.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},ni=class{constructor(e=0,t=0,n=0,s=1){this.isQuaternion=!0,this._x=e,this._y=t,this._z=n,this._w=s}static slerpFlat(e,t,n,s,o,c,h){let d=n[s+0],f=n[s+1],p=n[s+2],_=n[s+3],g=o[c+0],S=o[c+1],w=o[c+2],R=o[c+3];if(_!==R||d!==g||f!==S||p!==w){let x=d*g+f*S+p*w+_*R;x<0&&(g=-g,S=-S,w=-w,R=-R,x=-x);let y=1-h;if(x<.9995){let P=Math.acos(x),U=Math.sin(P);y=Math.sin(y*P)/U,h=Math.sin(h*P)/U,d=d*y+g*h,f=f*y+S*h,p=p*y+w*h,_=_*y+R*h}else{d=d*y+g*h,f=f*y+S*h,p=p*y+w*h,_=_*y+R*h;let P=1/Math.sqrt(d*d+f*f+p*p+_*_);d*=P,f*=P,p*=P,_*=P}}e[t]=d,e[t+1]=f,e[t+2]=p,e[t+3]=_}static multiplyQuaternionsFlat(e,t,n,s,o,c){let h=n[s],d=n[s+1],f=n[s+2],p=n[s+3],_=o[c],g=o[c+1],S=o[c+2],w=o[c+3];return e[t]=h*w+p*_+d*S-f*g,e[t+1]=d*w+p*g+f*_-h*S,e[t+2]=f*w+p*S+h*g-d*_,e[t+3]=p*w-h*_-d*g-f*S,e}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get w(){return this._w}set w(e){this._w=e,this._onChangeCallback()}set(e,t,n,s){return this._x=e,this._y=t,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(e){return this._x=e.x,this._y=e.y,this._z=e.z,this._w=e.w,this._onChangeCallback(),this}setFromEuler(e,t=!0){let n=e._x,s=e._y,o=e._z,c=e._order,h=Math.cos,d=Math.sin,f=h(n/2),p=h(s/2),_=h(o/2),g=d(n/2),S=d(s/2),w=d(o/2);switch(c){case"XYZ":this._x=g*p*_+f*S*w,this._y=f*S*_-g*p*w,this._z=f*p*w+g*S*_,this._w=f*p*_-g*S*w;break;case"YXZ":this._x=g*p*_+f*S*w,this._y=f*S*_-g*p*w,this._z=f*p*w-g*S*_,this._w=f*p*_+g*S*w;break;case"ZXY":this._x=g*p*_-f*S*w,this._y=f*S*_+g*p*w,this._z=f*p*w+g*S*_,this._w=f*p*_-g*S*w;break;case"ZYX":this._x=g*p*_-f*S*w,this._y=f*S*_+g*p*w,this._z=f*p*w-g*S*_,this._w=f*p*_+g*S*w;break;case"YZX":this._x=g*p*_+f*S*w,this._y=f*S*_+g*p*w,this._z=f*p*w-g*S*_,this._w=f*p*_-g*S*w;break;case"XZY":this._x=g*p*_-f*S*w,this._y=f*S*_-g*p*w,this._z=f*p*w+g*S*_,this._w=f*p*_+g*S*w;break;default:Qe("Quaternion: .setFromEuler() encountered an unknown order: "+c)}return t===!0&&this._onChangeCallback(),this}setFromAxisAngle(e,t){let n=t/2,s=Math.sin(n);return this._x=e.x*s,this._y=e.y*s,this._z=e.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(e){let t=e.elements,n=t[0],s=t[4],o=t[8],c=t[1],h=t[5],d=t[9],f=t[2],p=t[6],_=t[10],g=n+h+_;if(g>0){let S=.5/Math.sqrt(g+1);this._w=.25/S,this._x=(p-d)*S,this._y=(o-f)*S,this._z=(c-s)*S}else if(n>h&&n>_){let S=2*Math.sqrt(1+n-h-_);this._w=(p-d)/S,this._x=.25*S,this._y=(s+c)/S,this._z=(o+f)/S}else if(h>_){let S=2*Math.sqrt(1+h-n-_);this._w=(o-f)/S,this._x=(s+c)/S,this._y=.25*S,this._z=(d+p)/S}else{let S=2*Math.sqrt(1+_-n-h);this._w=(c-s)/S,this._x=(o+f)/S,this._y=(d+p)/S,this._z=.25*S}return this._onChangeCallback(),this}setFromUnitVectors(e,t){let n=e.dot(t)+1;return n<1e-8?(n=0,Math.abs(e.x)>Math.abs(e.z)?(this._x=-e.y,this._y=e.x,this._z=0,this._w=n):(this._x=0,this._y=-e.z,this._z=e.y,this._w=n)):(this._x=e.y*t.z-e.z*t.y,this._y=e.z*t.x-e.x*t.z,this._z=e.x*t.y-e.y*t.x,this._w=n),this.normalize()}angleTo(e){return 2*Math.acos(Math.abs(xt(this.dot(e),-1,1)))}rotateTowards(e,t){let n=this.angleTo(e);if(n===0)return this;let s=Math.min(1,t/n);return this.slerp(e,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(e){return this._x*e._x+this._y*e._y+this._z*e._z+this._w*e._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let e=this.length();return e===0?(this._x=0,this._y=0,this._z=0,this._w=1):(e=1/e,this._x=this._x*e,this._y=this._y*e,this._z=this._z*e,this._w=this._w*e),this._onChangeCallback(),this}multiply(e){return this.multiplyQuaternions(this,e)}premultiply(e){return this.multiplyQuaternions(e,this)}multiplyQuaternions(e,t){let n=e._x,s=e._y,o=e._z,c=e._w,h=t._x,d=t._y,f=t._z,p=t._w;return this._x=n*p+c*h+s*f-o*d,this._y=s*p+c*d+o*h-n*f,this._z=o*p+c*f+n*d-s*h,this._w=c*p-n*h-s*d-o*f,this._onChangeCallback(),this}slerp(e,t){let n=e._x,s=e._y,o=e._z,c=e._w,h=this.dot(e);h<0&&(n=-n,s=-s,o=-o,c=-c,h=-h);let d=1-t;if(h<.9995){let f=Math.acos(h),p=Math.sin(f);d=Math.sin(d*f)/p,t=Math.sin(t*f)/p,this._x=this._x*d+n*t,this._y=this._y*d+s*t,this._z=this._z*d+o*t,this._w=this._w*d+c*t,this._onChangeCallback()}else this._x=this._x*d+n*t,this._y=this._y*d+s*t,this._z=this._z*d+o*t,this._w=this._w*d+c*t,this.normalize();return this}slerpQuaternions(e,t,n){return this.copy(e).slerp(t,n)}random(){let e=2*Math.PI*Math.random(),t=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),o=Math.sqrt(n);return this.set(s*Math.sin(e),s*Math.cos(e),o*Math.sin(t),o*Math.cos(t))}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._w===this._w}fromArray(e,t=0){return this._x=e[t],this._y=e[t+1],this._z=e[t+2],this._w=e[t+3],this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._w,e}fromBufferAttribute(e,t){return this._x=e.getX(t),this._y=e.getY(t),this._z=e.getZ(t),this._w=e.getW(t),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},Q=class{static{this.prototype.isVector3=!0}constructor(e=0,t=0,n=0){this.x=e,this.y=t,this.z=n}set(e,t,n){return n===void 0&&(n=this.z),this.x=e,this.y=t,this.z=n,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;default:throw new Error("THREE.Vector3: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this}multiplyVectors(e,t){return this.x=e.x*t.x,this.y=e.y*t.y,this.z=e.z*t.z,this}applyEuler(e){return this.applyQuaternion(Zh.setFromEuler(e))}applyAxisAngle(e,t){return this.applyQuaternion(Zh.setFromAxisAngle(e,t))}applyMatrix3(e){let t=this.x,n=this.y,s=this.z,o=e.elements;return this.x=o[0]*t+o[3]*n+o[6]*s,this.y=o[1]*t+o[4]*n+o[7]*s,this.z=o[2]*t+o[5]*n+o[8]*s,this}applyNormalMatrix(e){return this.applyMatrix3(e).normalize()}applyMatrix4(e){let t=this.x,n=this.y,s=this.z,o=e.elements,c=1/(o[3]*t+o[7]*n+o[11]*s+o[15]);return this.x=(o[0]*t+o[4]*n+o[8]*s+o[12])*c,this.y=(o[1]*t+o[5]*n+o[9]*s+o[13])*c,this.z=(o[2]*t+o[6]*n+o[10]*s+o[14])*c,this}applyQuaternion(e){let t=this.x,n=this.y,s=this.z,o=e.x,c=e.y,h=e.z,d=e.w,f=2*(c*s-h*n),p=2*(h*t-o*s),_=2*(o*n-c*t);return this.x=t+d*f+c*_-h*p,this.y=n+d*p+h*f-o*_,this.z=s+d*_+o*p-c*f,this}project(e){return this.applyMatrix4(e.matrixWorldInverse).applyMatrix4(e.projectionMatrix)}unproject(e){return this.applyMatrix4(e.projectionMatrixInverse).applyMatrix4(e.matrixWorld)}transformDirection(e){let t=this.x,n=this.y,s=this.z,o=e.elements;return this.x=o[0]*t+o[4]*n+o[8]*s,this.y=o[1]*t+o[5]*n+o[9]*s,this.z=o[2]*t+o[6]*n+o[10]*s,this.normalize()}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this}divideScalar(e){return this.multiplyScalar(1/e)}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this}clamp(e,t){return this.x=xt(this.x,e.x,t.x),this.y=xt(this.y,e.y,t.y),this.z=xt(this.z,e.z,t.z),this}clampScalar(e,t){return this.x=xt(this.x,e,t),this.y=xt(this.y,e,t),this.z=xt(this.z,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(xt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this}cross(e){return this.crossVectors(this,e)}crossVectors(e,t){let n=e.x,s=e.y,o=e.z,c=t.x,h=t.y,d=t.z;return this.x=s*d-o*h,this.y=o*c-n*d,this.z=n*h-s*c,this}projectOnVector(e){let t=e.lengthSq();if(t===0)return this.set(0,0,0);let n=e.dot(this)/t;return this.copy(e).multiplyScalar(n)}projectOnPlane(e){return Ll.copy(this).projectOnVector(e),this.sub(Ll)}reflect(e){return this.sub(Ll.copy(e).multiplyScalar(2*this.dot(e)))}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(xt(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y,s=this.z-e.z;return t*t+n*n+s*s}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)+Math.abs(this.z-e.z)}setFromSpherical(e){return this.setFromSphericalCoords(e.radius,e.phi,e.theta)}setFromSphericalCoords(e,t,n){let s=Math.sin(t)*e;return this.x=s*Math.sin(n),this.y=Math.cos(t)*e,this.z=s*Math.cos(n),this}setFromCylindrical(e){return this.setFromCylindricalCoords(e.radius,e.theta,e.y)}setFromCylindricalCoords(e,t,n){return this.x=e*Math.sin(t),this.y=n,this.z=e*Math.cos(t),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this}setFromMatrixScale(e){let t=this.setFromMatrixColumn(e,0).length(),n=this.setFromMatrixColumn(e,1).length(),s=this.setFromMatrixColumn(e,2).length();return this.x=t,this.y=n,this.z=s,this}setFromMatrixColumn(e,t){return this.fromArray(e.elements,t*4)}setFromMatrix3Column(e,t){return this.fromArray(e.elements,t*3)}setFromEuler(e){return this.x=e._x,this.y=e._y,this.z=e._z,this}setFromColor(e){return this.x=e.r,this.y=e.g,this.z=e.b,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let e=Math.random()*Math.PI*2,t=Math.random()*2-1,n=Math.sqrt(1-t*t);return this.x=n*Math.cos(e),this.y=t,this.z=n*Math.sin(e),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},Ll=new Q,Zh=new ni,at=class{static{this.prototype.isMatrix3=!0}constructor(e,t,n,s,o,c,h,d,f){this.elements=[1,0,0,0,1,0,0,0,1],e!==void 0&&this.set(e,t,n,s,o,c,h,d,f)}set(e,t,n,s,o,c,h,d,f){let p=this.elements;return p[0]=e,p[1]=s,p[2]=h,p[3]=t,p[4]=o,p[5]=d,p[6]=n,p[7]=c,p[8]=f,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],this}extractBasis(e,t,n){return e.setFromMatrix3Column(this,0),t.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(e){let t=e.elements;return this.set(t[0],t[4],t[8],t[1],t[5],t[9],t[2],t[6],t[10]),this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,s=t.elements,o=this.elements,c=n[0],h=n[3],d=n[6],f=n[1],p=n[4],_=n[7],g=n[2],S=n[5],w=n[8],R=s[0],x=s[3],y=s[6],P=s[1],U=s[4],I=s[7],O=s[2],N=s[5],b=s[8];return o[0]=c*R+h*P+d*O,o[3]=c*x+h*U+d*N,o[6]=c*y+h*I+d*b,o[1]=f*R+p*P+_*O,o[4]=f*x+p*U+_*N,o[7]=f*y+p*I+_*b,o[2]=g*R+S*P+w*O,o[5]=g*x+S*U+w*N,o[8]=g*y+S*I+w*b,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[3]*=e,t[6]*=e,t[1]*=e,t[4]*=e,t[7]*=e,t[2]*=e,t[5]*=e,t[8]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[1],s=e[2],o=e[3],c=e[4],h=e[5],d=e[6],f=e[7],p=e[8];return t*c*p-t*h*f-n*o*p+n*h*d+s*o*f-s*c*d}invert(){let e=this.elements,t=e[0],n=e[1],s=e[2],o=e[3],c=e[4],h=e[5],d=e[6],f=e[7],p=e[8],_=p*c-h*f,g=h*d-p*o,S=f*o-c*d,w=t*_+n*g+s*S;if(w===0)return this.set(0,0,0,0,0,0,0,0,0);let R=1/w;return e[0]=_*R,e[1]=(s*f-p*n)*R,e[2]=(h*n-s*c)*R,e[3]=g*R,e[4]=(p*t-s*d)*R,e[5]=(s*o-h*t)*R,e[6]=S*R,e[7]=(n*d-f*t)*R,e[8]=(c*t-n*o)*R,this}transpose(){let e,t=this.elements;return e=t[1],t[1]=t[3],t[3]=e,e=t[2],t[2]=t[6],t[6]=e,e=t[5],t[5]=t[7],t[7]=e,this}getNormalMatrix(e){return this.setFromMatrix4(e).invert().transpose()}transposeIntoArray(e){let t=this.elements;return e[0]=t[0],e[1]=t[3],e[2]=t[6],e[3]=t[1],e[4]=t[4],e[5]=t[7],e[6]=t[2],e[7]=t[5],e[8]=t[8],this}setUvTransform(e,t,n,s,o,c,h){let d=Math.cos(o),f=Math.sin(o);return this.set(n*d,n*f,-n*(d*c+f*h)+c+e,-s*f,s*d,-s*(-f*c+d*h)+h+t,0,0,1),this}scale(e,t){return as("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(Dl.makeScale(e,t)),this}rotate(e){return as("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(Dl.makeRotation(-e)),this}translate(e,t){return as("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(Dl.makeTranslation(e,t)),this}makeTranslation(e,t){return e.isVector2?this.set(1,0,e.x,0,1,e.y,0,0,1):this.set(1,0,e,0,1,t,0,0,1),this}makeRotation(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,n,t,0,0,0,1),this}makeScale(e,t){return this.set(e,0,0,0,t,0,0,0,1),this}equals(e){let t=this.elements,n=e.elements;for(let s=0;s<9;s++)if(t[s]!==n[s])return!1;return!0}fromArray(e,t=0){for(let n=0;n<9;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e}clone(){return new this.constructor().fromArray(this.elements)}},Dl=new at,Kh=new at().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Qh=new at().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function I0(){let i={enabled:!0,workingColorSpace:hs,spaces:{},convert:function(s,o,c){return this.enabled===!1||o===c||!o||!c||(this.spaces[o].transfer===Ct&&(s.r=mi(s.r),s.g=mi(s.g),s.b=mi(s.b)),this.spaces[o].primaries!==this.spaces[c].primaries&&(s.applyMatrix3(this.spaces[o].toXYZ),s.applyMatrix3(this.spaces[c].fromXYZ)),this.spaces[c].transfer===Ct&&(s.r=Ar(s.r),s.g=Ar(s.g),s.b=Ar(s.b))),s},workingToColorSpace:function(s,o){return this.convert(s,this.workingColorSpace,o)},colorSpaceToWorking:function(s,o){return this.convert(s,o,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===Mi?us:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,o=this.workingColorSpace){return s.fromArray(this.spaces[o].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,o,c){return s.copy(this.spaces[c].fromXYZ).multiply(this.spaces[o].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},e=[.64,.33,.3,.6,.15,.06],t=[.2126,.7152,.0722],n=[.3127,.329];return i.define({[hs]:{primaries:e,whitePoint:n,transfer:us,toXYZ:Kh,fromXYZ:Qh,luminanceCoefficients:t,workingColorSpaceConfig:{unpackColorSpace:mn},outputColorSpaceConfig:{drawingBufferColorSpace:mn}},[mn]:{primaries:e,whitePoint:n,transfer:Ct,toXYZ:Kh,fromXYZ:Qh,luminanceCoefficients:t,outputColorSpaceConfig:{drawingBufferColorSpace:mn}}}),i}var yt=I0();function mi(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function Ar(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}var pr,Xa=class{static getDataURL(e,t="image/png"){if(/^data:/i.test(e.src)||typeof HTMLCanvasElement>"u")return e.src;let n;if(e instanceof HTMLCanvasElement)n=e;else{pr===void 0&&(pr=ds("canvas")),pr.width=e.width,pr.height=e.height;let s=pr.getContext("2d");e instanceof ImageData?s.putImageData(e,0,0):s.drawImage(e,0,0,e.width,e.height),n=pr}return n.toDataURL(t)}static sRGBToLinear(e){if(typeof HTMLImageElement<"u"&&e instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&e instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&e instanceof ImageBitmap){let t=ds("canvas");t.width=e.width,t.height=e.height;let n=t.getContext("2d");n.drawImage(e,0,0,e.width,e.height);let s=n.getImageData(0,0,e.width,e.height),o=s.data;for(let c=0;c<o.length;c++)o[c]=mi(o[c]/255)*255;return n.putImageData(s,0,0),t}else if(e.data){let t=e.data.slice(0);for(let n=0;n<t.length;n++)t instanceof Uint8Array||t instanceof Uint8ClampedArray?t[n]=Math.floor(mi(t[n]/255)*255):t[n]=mi(t[n]);return{data:t,width:e.width,height:e.height}}else return Qe("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),e}},L0=0,Lr=class{constructor(e=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:L0++}),this.uuid=Wr(),this.data=e,this.dataReady=!0,this.version=0}getSize(e){let t=this.data;return typeof HTMLVideoElement<"u"&&t instanceof HTMLVideoElement?e.set(t.videoWidth,t.videoHeight,0):typeof VideoFrame<"u"&&t instanceof VideoFrame?e.set(t.displayWidth,t.displayHeight,0):t!==null?e.set(t.width||0,t.height||0,t.depth||0):e.set(0,0,0),e}set needsUpdate(e){e===!0&&this.version++}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.images[this.uuid]!==void 0)return e.images[this.uuid];let n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let o;if(Array.isArray(s)){o=[];for(let c=0,h=s.length;c<h;c++)s[c].isDataTexture?o.push(Fl(s[c].image)):o.push(Fl(s[c]))}else o=Fl(s);n.url=o}return t||(e.images[this.uuid]=n),n}};function Fl(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?Xa.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(Qe("Texture: Unable to serialize Texture."),{})}var D0=0,Nl=new Q,xn=class i extends ti{constructor(e=i.DEFAULT_IMAGE,t=i.DEFAULT_MAPPING,n=Qn,s=Qn,o=_n,c=xi,h=Hn,d=Sn,f=i.DEFAULT_ANISOTROPY,p=Mi){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:D0++}),this.uuid=Wr(),this.name="",this.source=new Lr(e),this.mipmaps=[],this.mapping=t,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=o,this.minFilter=c,this.anisotropy=f,this.format=h,this.internalFormat=null,this.type=d,this.offset=new gt(0,0),this.repeat=new gt(1,1),this.center=new gt(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new at,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=p,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(e&&e.depth&&e.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(Nl).x}get height(){return this.source.getSize(Nl).y}get depth(){return this.source.getSize(Nl).z}get image(){return this.source.data}set image(e){this.source.data=e}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(e){return this.name=e.name,this.source=e.source,this.mipmaps=e.mipmaps.slice(0),this.mapping=e.mapping,this.channel=e.channel,this.wrapS=e.wrapS,this.wrapT=e.wrapT,this.magFilter=e.magFilter,this.minFilter=e.minFilter,this.anisotropy=e.anisotropy,this.format=e.format,this.internalFormat=e.internalFormat,this.type=e.type,this.normalized=e.normalized,this.offset.copy(e.offset),this.repeat.copy(e.repeat),this.center.copy(e.center),this.rotation=e.rotation,this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrix.copy(e.matrix),this.generateMipmaps=e.generateMipmaps,this.mipmapsAutoUpdate=e.mipmapsAutoUpdate,this.premultiplyAlpha=e.premultiplyAlpha,this.flipY=e.flipY,this.unpackAlignment=e.unpackAlignment,this.colorSpace=e.colorSpace,this.renderTarget=e.renderTarget,this.isRenderTargetTexture=e.isRenderTargetTexture,this.isPMREMTexture=e.isPMREMTexture,this.isArrayTexture=e.isArrayTexture,this.userData=JSON.parse(JSON.stringify(e.userData)),this.needsUpdate=!0,this}setValues(e){for(let t in e){let n=e[t];if(n===void 0){Qe(`Texture.setValues(): parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Qe(`Texture.setValues(): property '${t}' does not exist.`);continue}s&&n&&s.isVector2&&n.isVector2||s&&n&&s.isVector3&&n.isVector3||s&&n&&s.isMatrix3&&n.isMatrix3?s.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.textures[this.uuid]!==void 0)return e.textures[this.uuid];let n={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(e).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),t||(e.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(e){if(this.mapping!==Sc)return e;if(e.applyMatrix3(this.matrix),e.x<0||e.x>1)switch(this.wrapS){case Va:e.x=e.x-Math.floor(e.x);break;case Qn:e.x=e.x<0?0:1;break;case Ha:Math.abs(Math.floor(e.x)%2)===1?e.x=Math.ceil(e.x)-e.x:e.x=e.x-Math.floor(e.x);break}if(e.y<0||e.y>1)switch(this.wrapT){case Va:e.y=e.y-Math.floor(e.y);break;case Qn:e.y=e.y<0?0:1;break;case Ha:Math.abs(Math.floor(e.y)%2)===1?e.y=Math.ceil(e.y)-e.y:e.y=e.y-Math.floor(e.y);break}return this.flipY&&(e.y=1-e.y),e}set needsUpdate(e){e===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(e){e===!0&&this.pmremVersion++}};xn.DEFAULT_IMAGE=null;xn.DEFAULT_MAPPING=Sc;xn.DEFAULT_ANISOTROPY=1;var zt=class{static{this.prototype.isVector4=!0}constructor(e=0,t=0,n=0,s=1){this.x=e,this.y=t,this.z=n,this.w=s}get width(){return this.z}set width(e){this.z=e}get height(){return this.w}set height(e){this.w=e}set(e,t,n,s){return this.x=e,this.y=t,this.z=n,this.w=s,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this.w=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setW(e){return this.w=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;case 3:this.w=t;break;default:throw new Error("THREE.Vector4: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this.w=e.w!==void 0?e.w:1,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this.w+=e.w,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this.w+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this.w=e.w+t.w,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this.w+=e.w*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this.w-=e.w,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this.w-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this.w=e.w-t.w,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this.w*=e.w,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this.w*=e,this}applyMatrix4(e){let t=this.x,n=this.y,s=this.z,o=this.w,c=e.elements;return this.x=c[0]*t+c[4]*n+c[8]*s+c[12]*o,this.y=c[1]*t+c[5]*n+c[9]*s+c[13]*o,this.z=c[2]*t+c[6]*n+c[10]*s+c[14]*o,this.w=c[3]*t+c[7]*n+c[11]*s+c[15]*o,this}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this.w/=e.w,this}divideScalar(e){return this.multiplyScalar(1/e)}setAxisAngleFromQuaternion(e){this.w=2*Math.acos(e.w);let t=Math.sqrt(1-e.w*e.w);return t<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=e.x/t,this.y=e.y/t,this.z=e.z/t),this}setAxisAngleFromRotationMatrix(e){let t,n,s,o,d=e.elements,f=d[0],p=d[4],_=d[8],g=d[1],S=d[5],w=d[9],R=d[2],x=d[6],y=d[10];if(Math.abs(p-g)<.01&&Math.abs(_-R)<.01&&Math.abs(w-x)<.01){if(Math.abs(p+g)<.1&&Math.abs(_+R)<.1&&Math.abs(w+x)<.1&&Math.abs(f+S+y-3)<.1)return this.set(1,0,0,0),this;t=Math.PI;let U=(f+1)/2,I=(S+1)/2,O=(y+1)/2,N=(p+g)/4,b=(_+R)/4,L=(w+x)/4;return U>I&&U>O?U<.01?(n=0,s=.707106781,o=.707106781):(n=Math.sqrt(U),s=N/n,o=b/n):I>O?I<.01?(n=.707106781,s=0,o=.707106781):(s=Math.sqrt(I),n=N/s,o=L/s):O<.01?(n=.707106781,s=.707106781,o=0):(o=Math.sqrt(O),n=b/o,s=L/o),this.set(n,s,o,t),this}let P=Math.sqrt((x-w)*(x-w)+(_-R)*(_-R)+(g-p)*(g-p));return Math.abs(P)<.001&&(P=1),this.x=(x-w)/P,this.y=(_-R)/P,this.z=(g-p)/P,this.w=Math.acos((f+S+y-1)/2),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this.w=t[15],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this.w=Math.min(this.w,e.w),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this.w=Math.max(this.w,e.w),this}clamp(e,t){return this.x=xt(this.x,e.x,t.x),this.y=xt(this.y,e.y,t.y),this.z=xt(this.z,e.z,t.z),this.w=xt(this.w,e.w,t.w),this}clampScalar(e,t){return this.x=xt(this.x,e,t),this.y=xt(this.y,e,t),this.z=xt(this.z,e,t),this.w=xt(this.w,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(xt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z+this.w*e.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this.w+=(e.w-this.w)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this.w=e.w+(t.w-e.w)*n,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z&&e.w===this.w}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this.w=e[t+3],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e[t+3]=this.w,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this.w=e.getW(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},$a=class extends ti{constructor(e=1,t=1,n={}){super(),n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:_n,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},n),this.isRenderTarget=!0,this.width=e,this.height=t,this.depth=n.depth,this.scissor=new zt(0,0,e,t),this.scissorTest=!1,this.viewport=new zt(0,0,e,t),this.textures=[];let s=n.count;for(let o=0;o<s;o++)this.textures[o]=new xn({width:e,height:t,depth:n.depth}),this.textures[o].isRenderTargetTexture=!0,this.textures[o].renderTarget=this;this._setTextureOptions(n),this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveColorBuffer=n.resolveColorBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.storeMultisampledColorBuffer=n.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=n.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=n.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=n.depthTexture,this.samples=n.samples,this.multiview=n.multiview,this.useArrayDepthTexture=n.useArrayDepthTexture}_setTextureOptions(e={}){let t={minFilter:_n,generateMipmaps:!1,flipY:!1,internalFormat:null};e.mapping!==void 0&&(t.mapping=e.mapping),e.wrapS!==void 0&&(t.wrapS=e.wrapS),e.wrapT!==void 0&&(t.wrapT=e.wrapT),e.wrapR!==void 0&&(t.wrapR=e.wrapR),e.magFilter!==void 0&&(t.magFilter=e.magFilter),e.minFilter!==void 0&&(t.minFilter=e.minFilter),e.format!==void 0&&(t.format=e.format),e.type!==void 0&&(t.type=e.type),e.anisotropy!==void 0&&(t.anisotropy=e.anisotropy),e.colorSpace!==void 0&&(t.colorSpace=e.colorSpace),e.flipY!==void 0&&(t.flipY=e.flipY),e.generateMipmaps!==void 0&&(t.generateMipmaps=e.generateMipmaps),e.mipmapsAutoUpdate!==void 0&&(t.mipmapsAutoUpdate=e.mipmapsAutoUpdate),e.internalFormat!==void 0&&(t.internalFormat=e.internalFormat);for(let n=0;n<this.textures.length;n++)this.textures[n].setValues(t)}get texture(){return this.textures[0]}set texture(e){this.textures[0]=e}set depthTexture(e){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),e!==null&&e.renderTarget===null&&(e.renderTarget=this),this._depthTexture=e}get depthTexture(){return this._depthTexture}setSize(e,t,n=1){if(this.width!==e||this.height!==t||this.depth!==n){this.width=e,this.height=t,this.depth=n;for(let s=0,o=this.textures.length;s<o;s++)this.textures[s].image.width=e,this.textures[s].image.height=t,this.textures[s].image.depth=n,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,e,t),this.scissor.set(0,0,e,t)}clone(){return new this.constructor().copy(this)}copy(e){this.width=e.width,this.height=e.height,this.depth=e.depth,this.scissor.copy(e.scissor),this.scissorTest=e.scissorTest,this.viewport.copy(e.viewport),this.textures.length=0;for(let t=0,n=e.textures.length;t<n;t++){this.textures[t]=e.textures[t].clone(),this.textures[t].isRenderTargetTexture=!0,this.textures[t].renderTarget=this;let s=Object.assign({},e.textures[t].image);this.textures[t].source=new Lr(s)}if(this.depthBuffer=e.depthBuffer,this.stencilBuffer=e.stencilBuffer,this.resolveColorBuffer=e.resolveColorBuffer,this.resolveDepthBuffer=e.resolveDepthBuffer,this.resolveStencilBuffer=e.resolveStencilBuffer,this.storeMultisampledColorBuffer=e.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=e.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=e.storeMultisampledStencilBuffer,e.depthTexture!==null)if(e.depthTexture.renderTarget===e){let t=e.depthTexture.clone();t.renderTarget=null,this.depthTexture=t}else this.depthTexture=e.depthTexture;else this.depthTexture=null;return this.samples=e.samples,this.multiview=e.multiview,this.useArrayDepthTexture=e.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},En=class extends $a{constructor(e=1,t=1,n={}){super(e,t,n),this.isWebGLRenderTarget=!0}},fs=class extends xn{constructor(e=null,t=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:e,width:t,height:n,depth:s},this.magFilter=sn,this.minFilter=sn,this.wrapR=Qn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}addLayerUpdate(e){this.layerUpdates.add(e)}clearLayerUpdates(){this.layerUpdates.clear()}};var qa=class extends xn{constructor(e=null,t=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:e,width:t,height:n,depth:s},this.magFilter=sn,this.minFilter=sn,this.wrapR=Qn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}};var It=class i{static{this.prototype.isMatrix4=!0}constructor(e,t,n,s,o,c,h,d,f,p,_,g,S,w,R,x){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],e!==void 0&&this.set(e,t,n,s,o,c,h,d,f,p,_,g,S,w,R,x)}set(e,t,n,s,o,c,h,d,f,p,_,g,S,w,R,x){let y=this.elements;return y[0]=e,y[4]=t,y[8]=n,y[12]=s,y[1]=o,y[5]=c,y[9]=h,y[13]=d,y[2]=f,y[6]=p,y[10]=_,y[14]=g,y[3]=S,y[7]=w,y[11]=R,y[15]=x,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new i().fromArray(this.elements)}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],t[9]=n[9],t[10]=n[10],t[11]=n[11],t[12]=n[12],t[13]=n[13],t[14]=n[14],t[15]=n[15],this}copyPosition(e){let t=this.elements,n=e.elements;return t[12]=n[12],t[13]=n[13],t[14]=n[14],this}setFromMatrix3(e){let t=e.elements;return this.set(t[0],t[3],t[6],0,t[1],t[4],t[7],0,t[2],t[5],t[8],0,0,0,0,1),this}extractBasis(e,t,n){return this.determinantAffine()===0?(e.set(1,0,0),t.set(0,1,0),n.set(0,0,1),this):(e.setFromMatrixColumn(this,0),t.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this)}makeBasis(e,t,n){return this.set(e.x,t.x,n.x,0,e.y,t.y,n.y,0,e.z,t.z,n.z,0,0,0,0,1),this}extractRotation(e){if(e.determinantAffine()===0)return this.identity();let t=this.elements,n=e.elements,s=1/mr.setFromMatrixColumn(e,0).length(),o=1/mr.setFromMatrixColumn(e,1).length(),c=1/mr.setFromMatrixColumn(e,2).length();return t[0]=n[0]*s,t[1]=n[1]*s,t[2]=n[2]*s,t[3]=0,t[4]=n[4]*o,t[5]=n[5]*o,t[6]=n[6]*o,t[7]=0,t[8]=n[8]*c,t[9]=n[9]*c,t[10]=n[10]*c,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromEuler(e){let t=this.elements,n=e.x,s=e.y,o=e.z,c=Math.cos(n),h=Math.sin(n),d=Math.cos(s),f=Math.sin(s),p=Math.cos(o),_=Math.sin(o);if(e.order==="XYZ"){let g=c*p,S=c*_,w=h*p,R=h*_;t[0]=d*p,t[4]=-d*_,t[8]=f,t[1]=S+w*f,t[5]=g-R*f,t[9]=-h*d,t[2]=R-g*f,t[6]=w+S*f,t[10]=c*d}else if(e.order==="YXZ"){let g=d*p,S=d*_,w=f*p,R=f*_;t[0]=g+R*h,t[4]=w*h-S,t[8]=c*f,t[1]=c*_,t[5]=c*p,t[9]=-h,t[2]=S*h-w,t[6]=R+g*h,t[10]=c*d}else if(e.order==="ZXY"){let g=d*p,S=d*_,w=f*p,R=f*_;t[0]=g-R*h,t[4]=-c*_,t[8]=w+S*h,t[1]=S+w*h,t[5]=c*p,t[9]=R-g*h,t[2]=-c*f,t[6]=h,t[10]=c*d}else if(e.order==="ZYX"){let g=c*p,S=c*_,w=h*p,R=h*_;t[0]=d*p,t[4]=w*f-S,t[8]=g*f+R,t[1]=d*_,t[5]=R*f+g,t[9]=S*f-w,t[2]=-f,t[6]=h*d,t[10]=c*d}else if(e.order==="YZX"){let g=c*d,S=c*f,w=h*d,R=h*f;t[0]=d*p,t[4]=R-g*_,t[8]=w*_+S,t[1]=_,t[5]=c*p,t[9]=-h*p,t[2]=-f*p,t[6]=S*_+w,t[10]=g-R*_}else if(e.order==="XZY"){let g=c*d,S=c*f,w=h*d,R=h*f;t[0]=d*p,t[4]=-_,t[8]=f*p,t[1]=g*_+R,t[5]=c*p,t[9]=S*_-w,t[2]=w*_-S,t[6]=h*p,t[10]=R*_+g}return t[3]=0,t[7]=0,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromQuaternion(e){return this.compose(F0,e,N0)}lookAt(e,t,n){let s=this.elements;return bn.subVectors(e,t),bn.lengthSq()===0&&(bn.z=1),bn.normalize(),Ei.crossVectors(n,bn),Ei.lengthSq()===0&&(Math.abs(n.z)===1?bn.x+=1e-4:bn.z+=1e-4,bn.normalize(),Ei.crossVectors(n,bn)),Ei.normalize(),ua.crossVectors(bn,Ei),s[0]=Ei.x,s[4]=ua.x,s[8]=bn.x,s[1]=Ei.y,s[5]=ua.y,s[9]=bn.y,s[2]=Ei.z,s[6]=ua.z,s[10]=bn.z,this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,s=t.elements,o=this.elements,c=n[0],h=n[4],d=n[8],f=n[12],p=n[1],_=n[5],g=n[9],S=n[13],w=n[2],R=n[6],x=n[10],y=n[14],P=n[3],U=n[7],I=n[11],O=n[15],N=s[0],b=s[4],L=s[8],q=s[12],k=s[1],Y=s[5],J=s[9],ee=s[13],z=s[2],ie=s[6],G=s[10],ne=s[14],Se=s[3],re=s[7],H=s[11],me=s[15];return o[0]=c*N+h*k+d*z+f*Se,o[4]=c*b+h*Y+d*ie+f*re,o[8]=c*L+h*J+d*G+f*H,o[12]=c*q+h*ee+d*ne+f*me,o[1]=p*N+_*k+g*z+S*Se,o[5]=p*b+_*Y+g*ie+S*re,o[9]=p*L+_*J+g*G+S*H,o[13]=p*q+_*ee+g*ne+S*me,o[2]=w*N+R*k+x*z+y*Se,o[6]=w*b+R*Y+x*ie+y*re,o[10]=w*L+R*J+x*G+y*H,o[14]=w*q+R*ee+x*ne+y*me,o[3]=P*N+U*k+I*z+O*Se,o[7]=P*b+U*Y+I*ie+O*re,o[11]=P*L+U*J+I*G+O*H,o[15]=P*q+U*ee+I*ne+O*me,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[4]*=e,t[8]*=e,t[12]*=e,t[1]*=e,t[5]*=e,t[9]*=e,t[13]*=e,t[2]*=e,t[6]*=e,t[10]*=e,t[14]*=e,t[3]*=e,t[7]*=e,t[11]*=e,t[15]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[4],s=e[8],o=e[12],c=e[1],h=e[5],d=e[9],f=e[13],p=e[2],_=e[6],g=e[10],S=e[14],w=e[3],R=e[7],x=e[11],y=e[15],P=d*S-f*g,U=h*S-f*_,I=h*g-d*_,O=c*S-f*p,N=c*g-d*p,b=c*_-h*p;return t*(R*P-x*U+y*I)-n*(w*P-x*O+y*N)+s*(w*U-R*O+y*b)-o*(w*I-R*N+x*b)}determinantAffine(){let e=this.elements,t=e[0],n=e[4],s=e[8],o=e[1],c=e[5],h=e[9],d=e[2],f=e[6],p=e[10];return t*(c*p-h*f)-n*(o*p-h*d)+s*(o*f-c*d)}transpose(){let e=this.elements,t;return t=e[1],e[1]=e[4],e[4]=t,t=e[2],e[2]=e[8],e[8]=t,t=e[6],e[6]=e[9],e[9]=t,t=e[3],e[3]=e[12],e[12]=t,t=e[7],e[7]=e[13],e[13]=t,t=e[11],e[11]=e[14],e[14]=t,this}setPosition(e,t,n){let s=this.elements;return e.isVector3?(s[12]=e.x,s[13]=e.y,s[14]=e.z):(s[12]=e,s[13]=t,s[14]=n),this}invert(){let e=this.elements,t=e[0],n=e[1],s=e[2],o=e[3],c=e[4],h=e[5],d=e[6],f=e[7],p=e[8],_=e[9],g=e[10],S=e[11],w=e[12],R=e[13],x=e[14],y=e[15],P=t*h-n*c,U=t*d-s*c,I=t*f-o*c,O=n*d-s*h,N=n*f-o*h,b=s*f-o*d,L=p*R-_*w,q=p*x-g*w,k=p*y-S*w,Y=_*x-g*R,J=_*y-S*R,ee=g*y-S*x,z=P*ee-U*J+I*Y+O*k-N*q+b*L;if(z===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let ie=1/z;return e[0]=(h*ee-d*J+f*Y)*ie,e[1]=(s*J-n*ee-o*Y)*ie,e[2]=(R*b-x*N+y*O)*ie,e[3]=(g*N-_*b-S*O)*ie,e[4]=(d*k-c*ee-f*q)*ie,e[5]=(t*ee-s*k+o*q)*ie,e[6]=(x*I-w*b-y*U)*ie,e[7]=(p*b-g*I+S*U)*ie,e[8]=(c*J-h*k+f*L)*ie,e[9]=(n*k-t*J-o*L)*ie,e[10]=(w*N-R*I+y*P)*ie,e[11]=(_*I-p*N-S*P)*ie,e[12]=(h*q-c*Y-d*L)*ie,e[13]=(t*Y-n*q+s*L)*ie,e[14]=(R*U-w*O-x*P)*ie,e[15]=(p*O-_*U+g*P)*ie,this}scale(e){let t=this.elements,n=e.x,s=e.y,o=e.z;return t[0]*=n,t[4]*=s,t[8]*=o,t[1]*=n,t[5]*=s,t[9]*=o,t[2]*=n,t[6]*=s,t[10]*=o,t[3]*=n,t[7]*=s,t[11]*=o,this}getMaxScaleOnAxis(){let e=this.elements,t=e[0]*e[0]+e[1]*e[1]+e[2]*e[2],n=e[4]*e[4]+e[5]*e[5]+e[6]*e[6],s=e[8]*e[8]+e[9]*e[9]+e[10]*e[10];return Math.sqrt(Math.max(t,n,s))}makeTranslation(e,t,n){return e.isVector3?this.set(1,0,0,e.x,0,1,0,e.y,0,0,1,e.z,0,0,0,1):this.set(1,0,0,e,0,1,0,t,0,0,1,n,0,0,0,1),this}makeRotationX(e){let t=Math.cos(e),n=Math.sin(e);return this.set(1,0,0,0,0,t,-n,0,0,n,t,0,0,0,0,1),this}makeRotationY(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,0,n,0,0,1,0,0,-n,0,t,0,0,0,0,1),this}makeRotationZ(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,0,n,t,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(e,t){let n=Math.cos(t),s=Math.sin(t),o=1-n,c=e.x,h=e.y,d=e.z,f=o*c,p=o*h;return this.set(f*c+n,f*h-s*d,f*d+s*h,0,f*h+s*d,p*h+n,p*d-s*c,0,f*d-s*h,p*d+s*c,o*d*d+n,0,0,0,0,1),this}makeScale(e,t,n){return this.set(e,0,0,0,0,t,0,0,0,0,n,0,0,0,0,1),this}makeShear(e,t,n,s,o,c){return this.set(1,n,o,0,e,1,c,0,t,s,1,0,0,0,0,1),this}compose(e,t,n){let s=this.elements,o=t._x,c=t._y,h=t._z,d=t._w,f=o+o,p=c+c,_=h+h,g=o*f,S=o*p,w=o*_,R=c*p,x=c*_,y=h*_,P=d*f,U=d*p,I=d*_,O=n.x,N=n.y,b=n.z;return s[0]=(1-(R+y))*O,s[1]=(S+I)*O,s[2]=(w-U)*O,s[3]=0,s[4]=(S-I)*N,s[5]=(1-(g+y))*N,s[6]=(x+P)*N,s[7]=0,s[8]=(w+U)*b,s[9]=(x-P)*b,s[10]=(1-(g+R))*b,s[11]=0,s[12]=e.x,s[13]=e.y,s[14]=e.z,s[15]=1,this}decompose(e,t,n){let s=this.elements;e.x=s[12],e.y=s[13],e.z=s[14];let o=this.determinantAffine();if(o===0)return n.set(1,1,1),t.identity(),this;let c=mr.set(s[0],s[1],s[2]).length(),h=mr.set(s[4],s[5],s[6]).length(),d=mr.set(s[8],s[9],s[10]).length();o<0&&(c=-c),Un.copy(this);let f=1/c,p=1/h,_=1/d;return Un.elements[0]*=f,Un.elements[1]*=f,Un.elements[2]*=f,Un.elements[4]*=p,Un.elements[5]*=p,Un.elements[6]*=p,Un.elements[8]*=_,Un.elements[9]*=_,Un.elements[10]*=_,t.setFromRotationMatrix(Un),n.x=c,n.y=h,n.z=d,this}makePerspective(e,t,n,s,o,c,h=In,d=!1){let f=this.elements,p=2*o/(t-e),_=2*o/(n-s),g=(t+e)/(t-e),S=(n+s)/(n-s),w,R;if(d)w=o/(c-o),R=c*o/(c-o);else if(h===In)w=-(c+o)/(c-o),R=-2*c*o/(c-o);else if(h===Rr)w=-c/(c-o),R=-c*o/(c-o);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+h);return f[0]=p,f[4]=0,f[8]=g,f[12]=0,f[1]=0,f[5]=_,f[9]=S,f[13]=0,f[2]=0,f[6]=0,f[10]=w,f[14]=R,f[3]=0,f[7]=0,f[11]=-1,f[15]=0,this}makeOrthographic(e,t,n,s,o,c,h=In,d=!1){let f=this.elements,p=2/(t-e),_=2/(n-s),g=-(t+e)/(t-e),S=-(n+s)/(n-s),w,R;if(d)w=1/(c-o),R=c/(c-o);else if(h===In)w=-2/(c-o),R=-(c+o)/(c-o);else if(h===Rr)w=-1/(c-o),R=-o/(c-o);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+h);return f[0]=p,f[4]=0,f[8]=0,f[12]=g,f[1]=0,f[5]=_,f[9]=0,f[13]=S,f[2]=0,f[6]=0,f[10]=w,f[14]=R,f[3]=0,f[7]=0,f[11]=0,f[15]=1,this}equals(e){let t=this.elements,n=e.elements;for(let s=0;s<16;s++)if(t[s]!==n[s])return!1;return!0}fromArray(e,t=0){for(let n=0;n<16;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e[t+9]=n[9],e[t+10]=n[10],e[t+11]=n[11],e[t+12]=n[12],e[t+13]=n[13],e[t+14]=n[14],e[t+15]=n[15],e}},mr=new Q,Un=new It,F0=new Q(0,0,0),N0=new Q(1,1,1),Ei=new Q,ua=new Q,bn=new Q,eu=new It,tu=new ni,_i=class i{constructor(e=0,t=0,n=0,s=i.DEFAULT_ORDER){this.isEuler=!0,this._x=e,this._y=t,this._z=n,this._order=s}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get order(){return this._order}set order(e){this._order=e,this._onChangeCallback()}set(e,t,n,s=this._order){return this._x=e,this._y=t,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(e){return this._x=e._x,this._y=e._y,this._z=e._z,this._order=e._order,this._onChangeCallback(),this}setFromRotationMatrix(e,t=this._order,n=!0){let s=e.elements,o=s[0],c=s[4],h=s[8],d=s[1],f=s[5],p=s[9],_=s[2],g=s[6],S=s[10];switch(t){case"XYZ":this._y=Math.asin(xt(h,-1,1)),Math.abs(h)<.9999999?(this._x=Math.atan2(-p,S),this._z=Math.atan2(-c,o)):(this._x=Math.atan2(g,f),this._z=0);break;case"YXZ":this._x=Math.asin(-xt(p,-1,1)),Math.abs(p)<.9999999?(this._y=Math.atan2(h,S),this._z=Math.atan2(d,f)):(this._y=Math.atan2(-_,o),this._z=0);break;case"ZXY":this._x=Math.asin(xt(g,-1,1)),Math.abs(g)<.9999999?(this._y=Math.atan2(-_,S),this._z=Math.atan2(-c,f)):(this._y=0,this._z=Math.atan2(d,o));break;case"ZYX":this._y=Math.asin(-xt(_,-1,1)),Math.abs(_)<.9999999?(this._x=Math.atan2(g,S),this._z=Math.atan2(d,o)):(this._x=0,this._z=Math.atan2(-c,f));break;case"YZX":this._z=Math.asin(xt(d,-1,1)),Math.abs(d)<.9999999?(this._x=Math.atan2(-p,f),this._y=Math.atan2(-_,o)):(this._x=0,this._y=Math.atan2(h,S));break;case"XZY":this._z=Math.asin(-xt(c,-1,1)),Math.abs(c)<.9999999?(this._x=Math.atan2(g,f),this._y=Math.atan2(h,o)):(this._x=Math.atan2(-p,S),this._y=0);break;default:Qe("Euler: .setFromRotationMatrix() encountered an unknown order: "+t)}return this._order=t,n===!0&&this._onChangeCallback(),this}setFromQuaternion(e,t,n){return eu.makeRotationFromQuaternion(e),this.setFromRotationMatrix(eu,t,n)}setFromVector3(e,t=this._order){return this.set(e.x,e.y,e.z,t)}reorder(e){return tu.setFromEuler(this),this.setFromQuaternion(tu,e)}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._order===this._order}fromArray(e){return this._x=e[0],this._y=e[1],this._z=e[2],e[3]!==void 0&&(this._order=e[3]),this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._order,e}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};_i.DEFAULT_ORDER="XYZ";var Dr=class{constructor(){this.mask=1}set(e){this.mask=(1<<e|0)>>>0}enable(e){this.mask|=1<<e|0}enableAll(){this.mask=-1}toggle(e){this.mask^=1<<e|0}disable(e){this.mask&=~(1<<e|0)}disableAll(){this.mask=0}test(e){return(this.mask&e.mask)!==0}isEnabled(e){return(this.mask&(1<<e|0))!==0}},U0=0,nu=new Q,gr=new ni,hi=new It,da=new Q,ts=new Q,O0=new Q,B0=new ni,iu=new Q(1,0,0),ru=new Q(0,1,0),su=new Q(0,0,1),au={type:"added"},k0={type:"removed"},_r={type:"childadded",child:null},Ul={type:"childremoved",child:null},ln=class i extends ti{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:U0++}),this.uuid=Wr(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=i.DEFAULT_UP.clone();let e=new Q,t=new _i,n=new ni,s=new Q(1,1,1);function o(){n.setFromEuler(t,!1)}function c(){t.setFromQuaternion(n,void 0,!1)}t._onChange(o),n._onChange(c),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:e},rotation:{configurable:!0,enumerable:!0,value:t},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new It},normalMatrix:{value:new at}}),this.matrix=new It,this.matrixWorld=new It,this.matrixAutoUpdate=i.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=i.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new Dr,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(e){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(e),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(e){return this.quaternion.premultiply(e),this}setRotationFromAxisAngle(e,t){this.quaternion.setFromAxisAngle(e,t)}setRotationFromEuler(e){this.quaternion.setFromEuler(e,!0)}setRotationFromMatrix(e){this.quaternion.setFromRotationMatrix(e)}setRotationFromQuaternion(e){this.quaternion.copy(e)}rotateOnAxis(e,t){return gr.setFromAxisAngle(e,t),this.quaternion.multiply(gr),this}rotateOnWorldAxis(e,t){return gr.setFromAxisAngle(e,t),this.quaternion.premultiply(gr),this}rotateX(e){return this.rotateOnAxis(iu,e)}rotateY(e){return this.rotateOnAxis(ru,e)}rotateZ(e){return this.rotateOnAxis(su,e)}translateOnAxis(e,t){return nu.copy(e).applyQuaternion(this.quaternion),this.position.add(nu.multiplyScalar(t)),this}translateX(e){return this.translateOnAxis(iu,e)}translateY(e){return this.translateOnAxis(ru,e)}translateZ(e){return this.translateOnAxis(su,e)}localToWorld(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(this.matrixWorld)}worldToLocal(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(hi.copy(this.matrixWorld).invert())}lookAt(e,t,n){e.isVector3?da.copy(e):da.set(e,t,n);let s=this.parent;this.updateWorldMatrix(!0,!1),ts.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?hi.lookAt(ts,da,this.up):hi.lookAt(da,ts,this.up),this.quaternion.setFromRotationMatrix(hi),s&&(hi.extractRotation(s.matrixWorld),gr.setFromRotationMatrix(hi),this.quaternion.premultiply(gr.invert()))}add(e){if(arguments.length>1){for(let t=0;t<arguments.length;t++)this.add(arguments[t]);return this}return e===this?(tt("Object3D.add: object can't be added as a child of itself.",e),this):(e&&e.isObject3D?(e.removeFromParent(),e.parent=this,this.children.push(e),e.dispatchEvent(au),_r.child=e,this.dispatchEvent(_r),_r.child=null):tt("Object3D.add: object not an instance of THREE.Object3D.",e),this)}remove(e){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}let t=this.children.indexOf(e);return t!==-1&&(e.parent=null,this.children.splice(t,1),e.dispatchEvent(k0),Ul.child=e,this.dispatchEvent(Ul),Ul.child=null),this}removeFromParent(){let e=this.parent;return e!==null&&e.remove(this),this}clear(){return this.remove(...this.children)}attach(e){return this.updateWorldMatrix(!0,!1),hi.copy(this.matrixWorld).invert(),e.parent!==null&&(e.parent.updateWorldMatrix(!0,!1),hi.multiply(e.parent.matrixWorld)),e.applyMatrix4(hi),e.removeFromParent(),e.parent=this,this.children.push(e),e.updateWorldMatrix(!1,!0),e.dispatchEvent(au),_r.child=e,this.dispatchEvent(_r),_r.child=null,this}getObjectById(e){return this.getObjectByProperty("id",e)}getObjectByName(e){return this.getObjectByProperty("name",e)}getObjectByProperty(e,t){if(this[e]===t)return this;for(let n=0,s=this.children.length;n<s;n++){let c=this.children[n].getObjectByProperty(e,t);if(c!==void 0)return c}}getObjectsByProperty(e,t,n=[]){this[e]===t&&n.push(this);let s=this.children;for(let o=0,c=s.length;o<c;o++)s[o].getObjectsByProperty(e,t,n);return n}getWorldPosition(e){return this.updateWorldMatrix(!0,!1),e.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(ts,e,O0),e}getWorldScale(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(ts,B0,e),e}getWorldDirection(e){this.updateWorldMatrix(!0,!1);let t=this.matrixWorld.elements;return e.set(t[8],t[9],t[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(e){e(this);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].traverse(e)}traverseVisible(e){if(this.visible===!1)return;e(this);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].traverseVisible(e)}traverseAncestors(e){let t=this.parent;t!==null&&(e(t),t.traverseAncestors(e))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let e=this.pivot;if(e!==null){let t=e.x,n=e.y,s=e.z,o=this.matrix.elements;o[12]+=t-o[0]*t-o[4]*n-o[8]*s,o[13]+=n-o[1]*t-o[5]*n-o[9]*s,o[14]+=s-o[2]*t-o[6]*n-o[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(e){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||e)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,e=!0);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].updateMatrixWorld(e)}updateWorldMatrix(e,t,n=!1){let s=this.parent;if(e===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||n)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,n=!0),t===!0){let o=this.children;for(let c=0,h=o.length;c<h;c++)o[c].updateWorldMatrix(!1,!0,n)}}toJSON(e){let t=e===void 0||typeof e=="string",n={};t&&(e={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(h=>({...h,boundingBox:h.boundingBox?h.boundingBox.toJSON():void 0,boundingSphere:h.boundingSphere?h.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(h=>({...h})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(e),s.indirectTexture=this._indirectTexture.toJSON(e),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(e)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function o(h,d){return h[d.uuid]===void 0&&(h[d.uuid]=d.toJSON(e)),d.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(e).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(e).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=o(e.geometries,this.geometry);let h=this.geometry.parameters;if(h!==void 0&&h.shapes!==void 0){let d=h.shapes;if(Array.isArray(d))for(let f=0,p=d.length;f<p;f++){let _=d[f];o(e.shapes,_)}else o(e.shapes,d)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(o(e.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let h=[];for(let d=0,f=this.material.length;d<f;d++)h.push(o(e.materials,this.material[d]));s.material=h}else s.material=o(e.materials,this.material);if(this.children.length>0){s.children=[];for(let h=0;h<this.children.length;h++)s.children.push(this.children[h].toJSON(e).object)}if(this.animations.length>0){s.animations=[];for(let h=0;h<this.animations.length;h++){let d=this.animations[h];s.animations.push(o(e.animations,d))}}if(t){let h=c(e.geometries),d=c(e.materials),f=c(e.textures),p=c(e.images),_=c(e.shapes),g=c(e.skeletons),S=c(e.animations),w=c(e.nodes);h.length>0&&(n.geometries=h),d.length>0&&(n.materials=d),f.length>0&&(n.textures=f),p.length>0&&(n.images=p),_.length>0&&(n.shapes=_),g.length>0&&(n.skeletons=g),S.length>0&&(n.animations=S),w.length>0&&(n.nodes=w)}return n.object=s,n;function c(h){let d=[];for(let f in h){let p=h[f];delete p.metadata,d.push(p)}return d}}clone(e){return new this.constructor().copy(this,e)}copy(e,t=!0){if(this.name=e.name,this.up.copy(e.up),this.position.copy(e.position),this.rotation.order=e.rotation.order,this.quaternion.copy(e.quaternion),this.scale.copy(e.scale),this.pivot=e.pivot!==null?e.pivot.clone():null,this.matrix.copy(e.matrix),this.matrixWorld.copy(e.matrixWorld),this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrixWorldAutoUpdate=e.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=e.matrixWorldNeedsUpdate,this.layers.mask=e.layers.mask,this.visible=e.visible,this.castShadow=e.castShadow,this.receiveShadow=e.receiveShadow,this.frustumCulled=e.frustumCulled,this.renderOrder=e.renderOrder,this.static=e.static,this.animations=e.animations.slice(),this.userData=JSON.parse(JSON.stringify(e.userData)),t===!0)for(let n=0;n<e.children.length;n++){let s=e.children[n];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};ln.DEFAULT_UP=new Q(0,1,0);ln.DEFAULT_MATRIX_AUTO_UPDATE=!0;ln.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Qi=class extends ln{constructor(){super(),this.isGroup=!0,this.type="Group"}},z0={type:"move"},Fr=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Qi,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Qi,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new Q,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new Q),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Qi,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new Q,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new Q,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(e){return this._targetRay!==null&&this._targetRay.dispatchEvent(e),this._grip!==null&&this._grip.dispatchEvent(e),this._hand!==null&&this._hand.dispatchEvent(e),this}connect(e){if(e&&e.hand){let t=this._hand;if(t)for(let n of e.hand.values())this._getHandJoint(t,n)}return this.dispatchEvent({type:"connected",data:e}),this}disconnect(e){return this.dispatchEvent({type:"disconnected",data:e}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(e,t,n){let s=null,o=null,c=null,h=this._targetRay,d=this._grip,f=this._hand;if(e&&t.session.visibilityState!=="visible-blurred"){if(f&&e.hand){c=!0;for(let R of e.hand.values()){let x=t.getJointPose(R,n),y=this._getHandJoint(f,R);x!==null&&(y.matrix.fromArray(x.transform.matrix),y.matrix.decompose(y.position,y.quaternion,y.scale),y.matrixWorldNeedsUpdate=!0,y.jointRadius=x.radius),y.visible=x!==null}let p=f.joints["index-finger-tip"],_=f.joints["thumb-tip"],g=p.position.distanceTo(_.position),S=.02,w=.005;f.inputState.pinching&&g>S+w?(f.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:e.handedness,target:this})):!f.inputState.pinching&&g<=S-w&&(f.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:e.handedness,target:this}))}else d!==null&&e.gripSpace&&(o=t.getPose(e.gripSpace,n),o!==null&&(d.matrix.fromArray(o.transform.matrix),d.matrix.decompose(d.position,d.quaternion,d.scale),d.matrixWorldNeedsUpdate=!0,o.linearVelocity?(d.hasLinearVelocity=!0,d.linearVelocity.copy(o.linearVelocity)):d.hasLinearVelocity=!1,o.angularVelocity?(d.hasAngularVelocity=!0,d.angularVelocity.copy(o.angularVelocity)):d.hasAngularVelocity=!1,d.eventsEnabled&&d.dispatchEvent({type:"gripUpdated",data:e,target:this})));h!==null&&(s=t.getPose(e.targetRaySpace,n),s===null&&o!==null&&(s=o),s!==null&&(h.matrix.fromArray(s.transform.matrix),h.matrix.decompose(h.position,h.quaternion,h.scale),h.matrixWorldNeedsUpdate=!0,s.linearVelocity?(h.hasLinearVelocity=!0,h.linearVelocity.copy(s.linearVelocity)):h.hasLinearVelocity=!1,s.angularVelocity?(h.hasAngularVelocity=!0,h.angularVelocity.copy(s.angularVelocity)):h.hasAngularVelocity=!1,this.dispatchEvent(z0)))}return h!==null&&(h.visible=s!==null),d!==null&&(d.visible=o!==null),f!==null&&(f.visible=c!==null),this}_getHandJoint(e,t){if(e.joints[t.jointName]===void 0){let n=new Qi;n.matrixAutoUpdate=!1,n.visible=!1,e.joints[t.jointName]=n,e.add(n)}return e.joints[t.jointName]}},hd={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},Ti={h:0,s:0,l:0},fa={h:0,s:0,l:0};function Ol(i,e,t){return t<0&&(t+=1),t>1&&(t-=1),t<1/6?i+(e-i)*6*t:t<1/2?e:t<2/3?i+(e-i)*6*(2/3-t):i}var ut=class{constructor(e,t,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(e,t,n)}set(e,t,n){if(t===void 0&&n===void 0){let s=e;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(e,t,n);return this}setScalar(e){return this.r=e,this.g=e,this.b=e,this}setHex(e,t=mn){return e=Math.floor(e),this.r=(e>>16&255)/255,this.g=(e>>8&255)/255,this.b=(e&255)/255,yt.colorSpaceToWorking(this,t),this}setRGB(e,t,n,s=yt.workingColorSpace){return this.r=e,this.g=t,this.b=n,yt.colorSpaceToWorking(this,s),this}setHSL(e,t,n,s=yt.workingColorSpace){if(e=Fc(e,1),t=xt(t,0,1),n=xt(n,0,1),t===0)this.r=this.g=this.b=n;else{let o=n<=.5?n*(1+t):n+t-n*t,c=2*n-o;this.r=Ol(c,o,e+1/3),this.g=Ol(c,o,e),this.b=Ol(c,o,e-1/3)}return yt.colorSpaceToWorking(this,s),this}setStyle(e,t=mn){function n(o){o!==void 0&&parseFloat(o)<1&&Qe("Color: Alpha component of "+e+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(e)){let o,c=s[1],h=s[2];switch(c){case"rgb":case"rgba":if(o=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(h))return n(o[4]),this.setRGB(Math.min(255,parseInt(o[1],10))/255,Math.min(255,parseInt(o[2],10))/255,Math.min(255,parseInt(o[3],10))/255,t);if(o=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(h))return n(o[4]),this.setRGB(Math.min(100,parseFloat(o[1]))/100,Math.min(100,parseFloat(o[2]))/100,Math.min(100,parseFloat(o[3]))/100,t);break;case"hsl":case"hsla":if(o=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(h))return n(o[4]),this.setHSL(parseFloat(o[1])/360,parseFloat(o[2])/100,parseFloat(o[3])/100,t);break;default:Qe("Color: Unknown color model "+e)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(e)){let o=s[1],c=o.length;if(c===3)return this.setRGB(parseInt(o.charAt(0),16)/15,parseInt(o.charAt(1),16)/15,parseInt(o.charAt(2),16)/15,t);if(c===6)return this.setHex(parseInt(o,16),t);Qe("Color: Invalid hex color "+e)}else if(e&&e.length>0)return this.setColorName(e,t);return this}setColorName(e,t=mn){let n=hd[e.toLowerCase()];return n!==void 0?this.setHex(n,t):Qe("Color: Unknown color "+e),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(e){return this.r=e.r,this.g=e.g,this.b=e.b,this}copySRGBToLinear(e){return this.r=mi(e.r),this.g=mi(e.g),this.b=mi(e.b),this}copyLinearToSRGB(e){return this.r=Ar(e.r),this.g=Ar(e.g),this.b=Ar(e.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(e=mn){return yt.workingToColorSpace(un.copy(this),e),Math.round(xt(un.r*255,0,255))*65536+Math.round(xt(un.g*255,0,255))*256+Math.round(xt(un.b*255,0,255))}getHexString(e=mn){return("000000"+this.getHex(e).toString(16)).slice(-6)}getHSL(e,t=yt.workingColorSpace){yt.workingToColorSpace(un.copy(this),t);let n=un.r,s=un.g,o=un.b,c=Math.max(n,s,o),h=Math.min(n,s,o),d,f,p=(h+c)/2;if(h===c)d=0,f=0;else{let _=c-h;switch(f=p<=.5?_/(c+h):_/(2-c-h),c){case n:d=(s-o)/_+(s<o?6:0);break;case s:d=(o-n)/_+2;break;case o:d=(n-s)/_+4;break}d/=6}return e.h=d,e.s=f,e.l=p,e}getRGB(e,t=yt.workingColorSpace){return yt.workingToColorSpace(un.copy(this),t),e.r=un.r,e.g=un.g,e.b=un.b,e}getStyle(e=mn){yt.workingToColorSpace(un.copy(this),e);let t=un.r,n=un.g,s=un.b;return e!==mn?`color(${e} ${t.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(t*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(e,t,n){return this.getHSL(Ti),this.setHSL(Ti.h+e,Ti.s+t,Ti.l+n)}add(e){return this.r+=e.r,this.g+=e.g,this.b+=e.b,this}addColors(e,t){return this.r=e.r+t.r,this.g=e.g+t.g,this.b=e.b+t.b,this}addScalar(e){return this.r+=e,this.g+=e,this.b+=e,this}sub(e){return this.r=Math.max(0,this.r-e.r),this.g=Math.max(0,this.g-e.g),this.b=Math.max(0,this.b-e.b),this}multiply(e){return this.r*=e.r,this.g*=e.g,this.b*=e.b,this}multiplyScalar(e){return this.r*=e,this.g*=e,this.b*=e,this}lerp(e,t){return this.r+=(e.r-this.r)*t,this.g+=(e.g-this.g)*t,this.b+=(e.b-this.b)*t,this}lerpColors(e,t,n){return this.r=e.r+(t.r-e.r)*n,this.g=e.g+(t.g-e.g)*n,this.b=e.b+(t.b-e.b)*n,this}lerpHSL(e,t){this.getHSL(Ti),e.getHSL(fa);let n=ls(Ti.h,fa.h,t),s=ls(Ti.s,fa.s,t),o=ls(Ti.l,fa.l,t);return this.setHSL(n,s,o),this}setFromVector3(e){return this.r=e.x,this.g=e.y,this.b=e.z,this}applyMatrix3(e){let t=this.r,n=this.g,s=this.b,o=e.elements;return this.r=o[0]*t+o[3]*n+o[6]*s,this.g=o[1]*t+o[4]*n+o[7]*s,this.b=o[2]*t+o[5]*n+o[8]*s,this}equals(e){return e.r===this.r&&e.g===this.g&&e.b===this.b}fromArray(e,t=0){return this.r=e[t],this.g=e[t+1],this.b=e[t+2],this}toArray(e=[],t=0){return e[t]=this.r,e[t+1]=this.g,e[t+2]=this.b,e}fromBufferAttribute(e,t){return this.r=e.getX(t),this.g=e.getY(t),this.b=e.getZ(t),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},un=new ut;ut.NAMES=hd;var ps=class extends ln{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new _i,this.environmentIntensity=1,this.environmentRotation=new _i,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(e,t){return super.copy(e,t),this.background=e.background!==null?e.background.clone():null,this.environment=e.environment!==null?e.environment.clone():null,this.fog=e.fog!==null?e.fog.clone():null,this.backgroundBlurriness=e.backgroundBlurriness,this.backgroundIntensity=e.backgroundIntensity,this.backgroundRotation.copy(e.backgroundRotation),this.environmentIntensity=e.environmentIntensity,this.environmentRotation.copy(e.environmentRotation),this.overrideMaterial=e.overrideMaterial!==null?e.overrideMaterial.clone():null,this.matrixAutoUpdate=e.matrixAutoUpdate,this}toJSON(e){let t=super.toJSON(e);return this.fog!==null&&(t.object.fog=this.fog.toJSON()),t.object.backgroundBlurriness=this.backgroundBlurriness,t.object.backgroundIntensity=this.backgroundIntensity,t.object.backgroundRotation=this.backgroundRotation.toArray(),t.object.environmentIntensity=this.environmentIntensity,t.object.environmentRotation=this.environmentRotation.toArray(),t}},On=new Q,ui=new Q,Bl=new Q,di=new Q,vr=new Q,yr=new Q,ou=new Q,kl=new Q,zl=new Q,Gl=new Q,Vl=new zt,Hl=new zt,Wl=new zt,Pi=class i{constructor(e=new Q,t=new Q,n=new Q){this.a=e,this.b=t,this.c=n}static getNormal(e,t,n,s){s.subVectors(n,t),On.subVectors(e,t),s.cross(On);let o=s.lengthSq();return o>0?s.multiplyScalar(1/Math.sqrt(o)):s.set(0,0,0)}static getBarycoord(e,t,n,s,o){On.subVectors(s,t),ui.subVectors(n,t),Bl.subVectors(e,t);let c=On.dot(On),h=On.dot(ui),d=On.dot(Bl),f=ui.dot(ui),p=ui.dot(Bl),_=c*f-h*h;if(_===0)return o.set(0,0,0),null;let g=1/_,S=(f*d-h*p)*g,w=(c*p-h*d)*g;return o.set(1-S-w,w,S)}static containsPoint(e,t,n,s){return this.getBarycoord(e,t,n,s,di)===null?!1:di.x>=0&&di.y>=0&&di.x+di.y<=1}static getInterpolation(e,t,n,s,o,c,h,d){return this.getBarycoord(e,t,n,s,di)===null?(d.x=0,d.y=0,"z"in d&&(d.z=0),"w"in d&&(d.w=0),null):(d.setScalar(0),d.addScaledVector(o,di.x),d.addScaledVector(c,di.y),d.addScaledVector(h,di.z),d)}static getInterpolatedAttribute(e,t,n,s,o,c){return Vl.setScalar(0),Hl.setScalar(0),Wl.setScalar(0),Vl.fromBufferAttribute(e,t),Hl.fromBufferAttribute(e,n),Wl.fromBufferAttribute(e,s),c.setScalar(0),c.addScaledVector(Vl,o.x),c.addScaledVector(Hl,o.y),c.addScaledVector(Wl,o.z),c}static isFrontFacing(e,t,n,s){return On.subVectors(n,t),ui.subVectors(e,t),On.cross(ui).dot(s)<0}set(e,t,n){return this.a.copy(e),this.b.copy(t),this.c.copy(n),this}setFromPointsAndIndices(e,t,n,s){return this.a.copy(e[t]),this.b.copy(e[n]),this.c.copy(e[s]),this}setFromAttributeAndIndices(e,t,n,s){return this.a.fromBufferAttribute(e,t),this.b.fromBufferAttribute(e,n),this.c.fromBufferAttribute(e,s),this}clone(){return new this.constructor().copy(this)}copy(e){return this.a.copy(e.a),this.b.copy(e.b),this.c.copy(e.c),this}getArea(){return On.subVectors(this.c,this.b),ui.subVectors(this.a,this.b),On.cross(ui).length()*.5}getMidpoint(e){return e.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(e){return i.getNormal(this.a,this.b,this.c,e)}getPlane(e){return e.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(e,t){return i.getBarycoord(e,this.a,this.b,this.c,t)}getInterpolation(e,t,n,s,o){return i.getInterpolation(e,this.a,this.b,this.c,t,n,s,o)}containsPoint(e){return i.containsPoint(e,this.a,this.b,this.c)}isFrontFacing(e){return i.isFrontFacing(this.a,this.b,this.c,e)}intersectsBox(e){return e.intersectsTriangle(this)}closestPointToPoint(e,t){let n=this.a,s=this.b,o=this.c,c,h;vr.subVectors(s,n),yr.subVectors(o,n),kl.subVectors(e,n);let d=vr.dot(kl),f=yr.dot(kl);if(d<=0&&f<=0)return t.copy(n);zl.subVectors(e,s);let p=vr.dot(zl),_=yr.dot(zl);if(p>=0&&_<=p)return t.copy(s);let g=d*_-p*f;if(g<=0&&d>=0&&p<=0&&d-p>0)return c=d/(d-p),t.copy(n).addScaledVector(vr,c);Gl.subVectors(e,o);let S=vr.dot(Gl),w=yr.dot(Gl);if(w>=0&&S<=w)return t.copy(o);let R=S*f-d*w;if(R<=0&&f>=0&&w<=0)return h=f/(f-w),t.copy(n).addScaledVector(yr,h);let x=p*w-S*_;if(x<=0&&_-p>=0&&S-w>=0)return ou.subVectors(o,s),h=(_-p)/(_-p+(S-w)),t.copy(s).addScaledVector(ou,h);let y=1/(x+R+g);return c=R*y,h=g*y,t.copy(n).addScaledVector(vr,c).addScaledVector(yr,h)}equals(e){return e.a.equals(this.a)&&e.b.equals(this.b)&&e.c.equals(this.c)}},Ii=class{constructor(e=new Q(1/0,1/0,1/0),t=new Q(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=e,this.max=t}set(e,t){return this.min.copy(e),this.max.copy(t),this}setFromArray(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t+=3)this.expandByPoint(Bn.fromArray(e,t));return this}setFromBufferAttribute(e){this.makeEmpty();for(let t=0,n=e.count;t<n;t++)this.expandByPoint(Bn.fromBufferAttribute(e,t));return this}setFromPoints(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t++)this.expandByPoint(e[t]);return this}setFromCenterAndSize(e,t){let n=Bn.copy(t).multiplyScalar(.5);return this.min.copy(e).sub(n),this.max.copy(e).add(n),this}setFromObject(e,t=!1){return this.makeEmpty(),this.expandByObject(e,t)}clone(){return new this.constructor().copy(this)}copy(e){return this.min.copy(e.min),this.max.copy(e.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(e){return this.isEmpty()?e.set(0,0,0):e.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(e){return this.isEmpty()?e.set(0,0,0):e.subVectors(this.max,this.min)}expandByPoint(e){return this.min.min(e),this.max.max(e),this}expandByVector(e){return this.min.sub(e),this.max.add(e),this}expandByScalar(e){return this.min.addScalar(-e),this.max.addScalar(e),this}expandByObject(e,t=!1){e.updateWorldMatrix(!1,!1);let n=e.geometry;if(n!==void 0){let o=n.getAttribute("position");if(t===!0&&o!==void 0&&e.isInstancedMesh!==!0&&e.isBatchedMesh!==!0)for(let c=0,h=o.count;c<h;c++)e.isMesh===!0?e.getVertexPosition(c,Bn):Bn.fromBufferAttribute(o,c),Bn.applyMatrix4(e.matrixWorld),this.expandByPoint(Bn);else e.boundingBox!==void 0?(e.boundingBox===null&&e.computeBoundingBox(),pa.copy(e.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),pa.copy(n.boundingBox)),pa.applyMatrix4(e.matrixWorld),this.union(pa)}let s=e.children;for(let o=0,c=s.length;o<c;o++)this.expandByObject(s[o],t);return this}containsPoint(e){return e.x>=this.min.x&&e.x<=this.max.x&&e.y>=this.min.y&&e.y<=this.max.y&&e.z>=this.min.z&&e.z<=this.max.z}containsBox(e){return this.min.x<=e.min.x&&e.max.x<=this.max.x&&this.min.y<=e.min.y&&e.max.y<=this.max.y&&this.min.z<=e.min.z&&e.max.z<=this.max.z}getParameter(e,t){return t.set((e.x-this.min.x)/(this.max.x-this.min.x),(e.y-this.min.y)/(this.max.y-this.min.y),(e.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(e){return e.max.x>=this.min.x&&e.min.x<=this.max.x&&e.max.y>=this.min.y&&e.min.y<=this.max.y&&e.max.z>=this.min.z&&e.min.z<=this.max.z}intersectsSphere(e){return this.clampPoint(e.center,Bn),Bn.distanceToSquared(e.center)<=e.radius*e.radius}intersectsPlane(e){let t,n;return e.normal.x>0?(t=e.normal.x*this.min.x,n=e.normal.x*this.max.x):(t=e.normal.x*this.max.x,n=e.normal.x*this.min.x),e.normal.y>0?(t+=e.normal.y*this.min.y,n+=e.normal.y*this.max.y):(t+=e.normal.y*this.max.y,n+=e.normal.y*this.min.y),e.normal.z>0?(t+=e.normal.z*this.min.z,n+=e.normal.z*this.max.z):(t+=e.normal.z*this.max.z,n+=e.normal.z*this.min.z),t<=-e.constant&&n>=-e.constant}intersectsTriangle(e){if(this.isEmpty())return!1;this.getCenter(ns),ma.subVectors(this.max,ns),xr.subVectors(e.a,ns),Sr.subVectors(e.b,ns),Mr.subVectors(e.c,ns),Ai.subVectors(Sr,xr),Ci.subVectors(Mr,Sr),ji.subVectors(xr,Mr);let t=[0,-Ai.z,Ai.y,0,-Ci.z,Ci.y,0,-ji.z,ji.y,Ai.z,0,-Ai.x,Ci.z,0,-Ci.x,ji.z,0,-ji.x,-Ai.y,Ai.x,0,-Ci.y,Ci.x,0,-ji.y,ji.x,0];return!Xl(t,xr,Sr,Mr,ma)||(t=[1,0,0,0,1,0,0,0,1],!Xl(t,xr,Sr,Mr,ma))?!1:(ga.crossVectors(Ai,Ci),t=[ga.x,ga.y,ga.z],Xl(t,xr,Sr,Mr,ma))}clampPoint(e,t){return t.copy(e).clamp(this.min,this.max)}distanceToPoint(e){return this.clampPoint(e,Bn).distanceTo(e)}getBoundingSphere(e){return this.isEmpty()?e.makeEmpty():(this.getCenter(e.center),e.radius=this.getSize(Bn).length()*.5),e}intersect(e){return this.min.max(e.min),this.max.min(e.max),this.isEmpty()&&this.makeEmpty(),this}union(e){return this.min.min(e.min),this.max.max(e.max),this}applyMatrix4(e){return this.isEmpty()?this:(fi[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(e),fi[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(e),fi[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(e),fi[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(e),fi[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(e),fi[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(e),fi[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(e),fi[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(e),this.setFromPoints(fi),this)}translate(e){return this.min.add(e),this.max.add(e),this}equals(e){return e.min.equals(this.min)&&e.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(e){return this.min.fromArray(e.min),this.max.fromArray(e.max),this}},fi=[new Q,new Q,new Q,new Q,new Q,new Q,new Q,new Q],Bn=new Q,pa=new Ii,xr=new Q,Sr=new Q,Mr=new Q,Ai=new Q,Ci=new Q,ji=new Q,ns=new Q,ma=new Q,ga=new Q,Ji=new Q;function Xl(i,e,t,n,s){for(let o=0,c=i.length-3;o<=c;o+=3){Ji.fromArray(i,o);let h=s.x*Math.abs(Ji.x)+s.y*Math.abs(Ji.y)+s.z*Math.abs(Ji.z),d=e.dot(Ji),f=t.dot(Ji),p=n.dot(Ji);if(Math.max(-Math.max(d,f,p),Math.min(d,f,p))>h)return!1}return!0}var $t=new Q,_a=new gt,G0=0,ei=class extends ti{constructor(e,t,n=!1){if(super(),Array.isArray(e))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:G0++}),this.name="",this.array=e,this.itemSize=t,this.count=e!==void 0?e.length/t:0,this.normalized=n,this.usage=id,this.updateRanges=[],this.gpuType=Gn,this.version=0,this._normalizationScale=e!==void 0?Uc(e):void 0}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.name=e.name,this.array=new e.array.constructor(e.array),this.itemSize=e.itemSize,this.count=e.count,this.normalized=e.normalized,this.usage=e.usage,this.gpuType=e.gpuType,this._normalizationScale=e._normalizationScale,this}copyAt(e,t,n){e*=this.itemSize,n*=t.itemSize;for(let s=0,o=this.itemSize;s<o;s++)this.array[e+s]=t.array[n+s];return this}copyArray(e){return this.array.set(e),this}applyMatrix3(e){if(this.itemSize===2)for(let t=0,n=this.count;t<n;t++)_a.fromBufferAttribute(this,t),_a.applyMatrix3(e),this.setXY(t,_a.x,_a.y);else if(this.itemSize===3)for(let t=0,n=this.count;t<n;t++)$t.fromBufferAttribute(this,t),$t.applyMatrix3(e),this.setXYZ(t,$t.x,$t.y,$t.z);return this}applyMatrix4(e){for(let t=0,n=this.count;t<n;t++)$t.fromBufferAttribute(this,t),$t.applyMatrix4(e),this.setXYZ(t,$t.x,$t.y,$t.z);return this}applyNormalMatrix(e){for(let t=0,n=this.count;t<n;t++)$t.fromBufferAttribute(this,t),$t.applyNormalMatrix(e),this.setXYZ(t,$t.x,$t.y,$t.z);return this}transformDirection(e){for(let t=0,n=this.count;t<n;t++)$t.fromBufferAttribute(this,t),$t.transformDirection(e),this.setXYZ(t,$t.x,$t.y,$t.z);return this}set(e,t=0){return this.array.set(e,t),this}getComponent(e,t){let n=this.array[e*this.itemSize+t];return this.normalized&&(n=this._denormalize(n)),n}setComponent(e,t,n){return this.normalized&&(n=this._normalize(n)),this.array[e*this.itemSize+t]=n,this}getX(e){let t=this.array[e*this.itemSize];return this.normalized&&(t=this._denormalize(t)),t}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize]=t,this}getY(e){let t=this.array[e*this.itemSize+1];return this.normalized&&(t=this._denormalize(t)),t}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+1]=t,this}getZ(e){let t=this.array[e*this.itemSize+2];return this.normalized&&(t=this._denormalize(t)),t}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+2]=t,this}getW(e){let t=this.array[e*this.itemSize+3];return this.normalized&&(t=this._denormalize(t)),t}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+3]=t,this}setXY(e,t,n){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n)),this.array[e+0]=t,this.array[e+1]=n,this}setXYZ(e,t,n,s){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=s,this}setXYZW(e,t,n,s,o){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s),o=this._normalize(o)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=s,this.array[e+3]=o,this}onUpload(e){return this.onUploadCallback=e,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let e={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return e.name=this.name,e.usage=this.usage,e.gpuType=this.gpuType,e}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):ld(e,this.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):cd(e,this.array)}};var ms=class extends ei{constructor(e,t,n){super(new Uint16Array(e),t,n)}};var gs=class extends ei{constructor(e,t,n){super(new Uint32Array(e),t,n)}};var Wt=class extends ei{constructor(e,t,n){super(new Float32Array(e),t,n)}},V0=new Ii,is=new Q,$l=new Q,er=class{constructor(e=new Q,t=-1){this.isSphere=!0,this.center=e,this.radius=t}set(e,t){return this.center.copy(e),this.radius=t,this}setFromPoints(e,t){let n=this.center;t!==void 0?n.copy(t):V0.setFromPoints(e).getCenter(n);let s=0;for(let o=0,c=e.length;o<c;o++)s=Math.max(s,n.distanceToSquared(e[o]));return this.radius=Math.sqrt(s),this}copy(e){return this.center.copy(e.center),this.radius=e.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(e){return e.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(e){return e.distanceTo(this.center)-this.radius}intersectsSphere(e){let t=this.radius+e.radius;return e.center.distanceToSquared(this.center)<=t*t}intersectsBox(e){return e.intersectsSphere(this)}intersectsPlane(e){return Math.abs(e.distanceToPoint(this.center))<=this.radius}clampPoint(e,t){let n=this.center.distanceToSquared(e);return t.copy(e),n>this.radius*this.radius&&(t.sub(this.center).normalize(),t.multiplyScalar(this.radius).add(this.center)),t}getBoundingBox(e){return this.isEmpty()?(e.makeEmpty(),e):(e.set(this.center,this.center),e.expandByScalar(this.radius),e)}applyMatrix4(e){return this.center.applyMatrix4(e),this.radius=this.radius*e.getMaxScaleOnAxis(),this}translate(e){return this.center.add(e),this}expandByPoint(e){if(this.isEmpty())return this.center.copy(e),this.radius=0,this;is.subVectors(e,this.center);let t=is.lengthSq();if(t>this.radius*this.radius){let n=Math.sqrt(t),s=(n-this.radius)*.5;this.center.addScaledVector(is,s/n),this.radius+=s}return this}union(e){return e.isEmpty()?this:this.isEmpty()?(this.copy(e),this):(this.center.equals(e.center)===!0?this.radius=Math.max(this.radius,e.radius):($l.subVectors(e.center,this.center).setLength(e.radius),this.expandByPoint(is.copy(e.center).add($l)),this.expandByPoint(is.copy(e.center).sub($l))),this)}equals(e){return e.center.equals(this.center)&&e.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(e){return this.radius=e.radius,this.center.fromArray(e.center),this}},H0=0,Pn=new It,ql=new ln,br=new Q,wn=new Ii,rs=new Ii,rn=new Q,vn=class i extends ti{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:H0++}),this.uuid=Wr(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(e){return Array.isArray(e)?this.index=new(p0(e)?gs:ms)(e,1):this.index=e,this}setIndirect(e,t=0){return this.indirect=e,this.indirectOffset=t,this}getIndirect(){return this.indirect}getAttribute(e){return this.attributes[e]}setAttribute(e,t){return this.attributes[e]=t,this}deleteAttribute(e){return delete this.attributes[e],this}hasAttribute(e){return this.attributes[e]!==void 0}addGroup(e,t,n=0){this.groups.push({start:e,count:t,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(e,t){this.drawRange.start=e,this.drawRange.count=t}applyMatrix4(e){let t=this.attributes.position;t!==void 0&&(t.applyMatrix4(e),t.needsUpdate=!0);let n=this.attributes.normal;if(n!==void 0){let o=new at().getNormalMatrix(e);n.applyNormalMatrix(o),n.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(e),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(e){return Pn.makeRotationFromQuaternion(e),this.applyMatrix4(Pn),this}rotateX(e){return Pn.makeRotationX(e),this.applyMatrix4(Pn),this}rotateY(e){return Pn.makeRotationY(e),this.applyMatrix4(Pn),this}rotateZ(e){return Pn.makeRotationZ(e),this.applyMatrix4(Pn),this}translate(e,t,n){return Pn.makeTranslation(e,t,n),this.applyMatrix4(Pn),this}scale(e,t,n){return Pn.makeScale(e,t,n),this.applyMatrix4(Pn),this}lookAt(e){return ql.lookAt(e),ql.updateMatrix(),this.applyMatrix4(ql.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(br).negate(),this.translate(br.x,br.y,br.z),this}setFromPoints(e){let t=this.getAttribute("position");if(t===void 0){let n=[];for(let s=0,o=e.length;s<o;s++){let c=e[s];n.push(c.x,c.y,c.z||0)}this.setAttribute("position",new Wt(n,3))}else{let n=Math.min(e.length,t.count);for(let s=0;s<n;s++){let o=e[s];t.setXYZ(s,o.x,o.y,o.z||0)}e.length>t.count&&Qe("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),t.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Ii);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){tt("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new Q(-1/0,-1/0,-1/0),new Q(1/0,1/0,1/0));return}if(e!==void 0){if(this.boundingBox.setFromBufferAttribute(e),t)for(let n=0,s=t.length;n<s;n++){let o=t[n];wn.setFromBufferAttribute(o),this.morphTargetsRelative?(rn.addVectors(this.boundingBox.min,wn.min),this.boundingBox.expandByPoint(rn),rn.addVectors(this.boundingBox.max,wn.max),this.boundingBox.expandByPoint(rn)):(this.boundingBox.expandByPoint(wn.min),this.boundingBox.expandByPoint(wn.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&tt('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new er);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){tt("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new Q,1/0);return}if(e){let n=this.boundingSphere.center;if(wn.setFromBufferAttribute(e),t)for(let o=0,c=t.length;o<c;o++){let h=t[o];rs.setFromBufferAttribute(h),this.morphTargetsRelative?(rn.addVectors(wn.min,rs.min),wn.expandByPoint(rn),rn.addVectors(wn.max,rs.max),wn.expandByPoint(rn)):(wn.expandByPoint(rs.min),wn.expandByPoint(rs.max))}wn.getCenter(n);let s=0;for(let o=0,c=e.count;o<c;o++)rn.fromBufferAttribute(e,o),s=Math.max(s,n.distanceToSquared(rn));if(t)for(let o=0,c=t.length;o<c;o++){let h=t[o],d=this.morphTargetsRelative;for(let f=0,p=h.count;f<p;f++)rn.fromBufferAttribute(h,f),d&&(br.fromBufferAttribute(e,f),rn.add(br)),s=Math.max(s,n.distanceToSquared(rn))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&tt('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let e=this.index,t=this.attributes;if(e===null||t.position===void 0||t.normal===void 0||t.uv===void 0){tt("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let n=t.position,s=t.normal,o=t.uv,c=this.getAttribute("tangent");(c===void 0||c.count!==n.count)&&(c=new ei(new Float32Array(4*n.count),4),this.setAttribute("tangent",c));let h=[],d=[],f=new Uint8Array(n.count);for(let q=0;q<n.count;q++)h[q]=new Q,d[q]=new Q;let p=new Q,_=new Q,g=new Q,S=new gt,w=new gt,R=new gt,x=new Q,y=new Q;function P(q,k,Y){f[q]=f[k]=f[Y]=1,p.fromBufferAttribute(n,q),_.fromBufferAttribute(n,k),g.fromBufferAttribute(n,Y),S.fromBufferAttribute(o,q),w.fromBufferAttribute(o,k),R.fromBufferAttribute(o,Y),_.sub(p),g.sub(p),w.sub(S),R.sub(S);let J=1/(w.x*R.y-R.x*w.y);isFinite(J)&&(x.copy(_).multiplyScalar(R.y).addScaledVector(g,-w.y).multiplyScalar(J),y.copy(g).multiplyScalar(w.x).addScaledVector(_,-R.x).multiplyScalar(J),h[q].add(x),h[k].add(x),h[Y].add(x),d[q].add(y),d[k].add(y),d[Y].add(y))}let U=this.groups;U.length===0&&(U=[{start:0,count:e.count}]);for(let q=0,k=U.length;q<k;++q){let Y=U[q],J=Y.start,ee=Y.count;for(let z=J,ie=J+ee;z<ie;z+=3)P(e.getX(z+0),e.getX(z+1),e.getX(z+2))}let I=new Q,O=new Q,N=new Q,b=new Q;function L(q){N.fromBufferAttribute(s,q),b.copy(N);let k=h[q];I.copy(k),I.sub(N.multiplyScalar(N.dot(k))).normalize(),O.crossVectors(b,k);let J=O.dot(d[q])<0?-1:1;c.setXYZW(q,I.x,I.y,I.z,J)}for(let q=0,k=n.count;q<k;++q)f[q]&&L(q);this._transformed=!0}computeVertexNormals(){let e=this.index,t=this.getAttribute("position");if(t!==void 0){let n=this.getAttribute("normal");if(n===void 0||n.count!==t.count)n=new ei(new Float32Array(t.count*3),3),this.setAttribute("normal",n);else for(let g=0,S=n.count;g<S;g++)n.setXYZ(g,0,0,0);let s=new Q,o=new Q,c=new Q,h=new Q,d=new Q,f=new Q,p=new Q,_=new Q;if(e)for(let g=0,S=e.count;g<S;g+=3){let w=e.getX(g+0),R=e.getX(g+1),x=e.getX(g+2);s.fromBufferAttribute(t,w),o.fromBufferAttribute(t,R),c.fromBufferAttribute(t,x),p.subVectors(c,o),_.subVectors(s,o),p.cross(_),h.fromBufferAttribute(n,w),d.fromBufferAttribute(n,R),f.fromBufferAttribute(n,x),h.add(p),d.add(p),f.add(p),n.setXYZ(w,h.x,h.y,h.z),n.setXYZ(R,d.x,d.y,d.z),n.setXYZ(x,f.x,f.y,f.z)}else for(let g=0,S=t.count;g<S;g+=3)s.fromBufferAttribute(t,g+0),o.fromBufferAttribute(t,g+1),c.fromBufferAttribute(t,g+2),p.subVectors(c,o),_.subVectors(s,o),p.cross(_),n.setXYZ(g+0,p.x,p.y,p.z),n.setXYZ(g+1,p.x,p.y,p.z),n.setXYZ(g+2,p.x,p.y,p.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){let e=this.attributes.normal;for(let t=0,n=e.count;t<n;t++)rn.fromBufferAttribute(e,t),rn.normalize(),e.setXYZ(t,rn.x,rn.y,rn.z)}toNonIndexed(){function e(h,d){let f=h.array,p=h.itemSize,_=h.normalized,g=new f.constructor(d.length*p),S=0,w=0;for(let R=0,x=d.length;R<x;R++){h.isInterleavedBufferAttribute?S=d[R]*h.data.stride+h.offset:S=d[R]*p;for(let y=0;y<p;y++)g[w++]=f[S++]}return new ei(g,p,_)}if(this.index===null)return Qe("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let t=new i,n=this.index.array,s=this.attributes;for(let h in s){let d=s[h],f=e(d,n);t.setAttribute(h,f)}let o=this.morphAttributes;for(let h in o){let d=[],f=o[h];for(let p=0,_=f.length;p<_;p++){let g=f[p],S=e(g,n);d.push(S)}t.morphAttributes[h]=d}t.morphTargetsRelative=this.morphTargetsRelative;let c=this.groups;for(let h=0,d=c.length;h<d;h++){let f=c[h];t.addGroup(f.start,f.count,f.materialIndex)}return t}toJSON(){let e={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(e.uuid=this.uuid,e.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,e.name=this.name,Object.keys(this.userData).length>0&&(e.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let d=this.parameters;for(let f in d)d[f]!==void 0&&(e[f]=d[f]);return e}e.data={attributes:{}};let t=this.index;t!==null&&(e.data.index={type:t.array.constructor.name,array:Array.prototype.slice.call(t.array)});let n=this.attributes;for(let d in n){let f=n[d];e.data.attributes[d]=f.toJSON(e.data)}let s={},o=!1;for(let d in this.morphAttributes){let f=this.morphAttributes[d],p=[];for(let _=0,g=f.length;_<g;_++){let S=f[_];p.push(S.toJSON(e.data))}p.length>0&&(s[d]=p,o=!0)}o&&(e.data.morphAttributes=s,e.data.morphTargetsRelative=this.morphTargetsRelative);let c=this.groups;c.length>0&&(e.data.groups=JSON.parse(JSON.stringify(c)));let h=this.boundingSphere;return h!==null&&(e.data.boundingSphere=h.toJSON()),e}clone(){return new this.constructor().copy(this)}copy(e){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let t={};this.name=e.name;let n=e.index;n!==null&&this.setIndex(n.clone());let s=e.attributes;for(let f in s){let p=s[f];this.setAttribute(f,p.clone(t))}let o=e.morphAttributes;for(let f in o){let p=[],_=o[f];for(let g=0,S=_.length;g<S;g++)p.push(_[g].clone(t));this.morphAttributes[f]=p}this.morphTargetsRelative=e.morphTargetsRelative;let c=e.groups;for(let f=0,p=c.length;f<p;f++){let _=c[f];this.addGroup(_.start,_.count,_.materialIndex)}let h=e.boundingBox;h!==null&&(this.boundingBox=h.clone());let d=e.boundingSphere;return d!==null&&(this.boundingSphere=d.clone()),this.drawRange.start=e.drawRange.start,this.drawRange.count=e.drawRange.count,this.userData=e.userData,this._transformed=e._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}};var Yl=new Q,W0=new Q,X0=new at,kn=class{constructor(e=new Q(1,0,0),t=0){this.isPlane=!0,this.normal=e,this.constant=t}set(e,t){return this.normal.copy(e),this.constant=t,this}setComponents(e,t,n,s){return this.normal.set(e,t,n),this.constant=s,this}setFromNormalAndCoplanarPoint(e,t){return this.normal.copy(e),this.constant=-t.dot(this.normal),this}setFromCoplanarPoints(e,t,n){let s=Yl.subVectors(n,t).cross(W0.subVectors(e,t)).normalize();return this.setFromNormalAndCoplanarPoint(s,e),this}copy(e){return this.normal.copy(e.normal),this.constant=e.constant,this}normalize(){let e=1/this.normal.length();return this.normal.multiplyScalar(e),this.constant*=e,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(e){return this.normal.dot(e)+this.constant}distanceToSphere(e){return this.distanceToPoint(e.center)-e.radius}projectPoint(e,t){return t.copy(e).addScaledVector(this.normal,-this.distanceToPoint(e))}intersectLine(e,t,n=!0){let s=e.delta(Yl),o=this.normal.dot(s);if(o===0)return this.distanceToPoint(e.start)===0?t.copy(e.start):null;let c=-(e.start.dot(this.normal)+this.constant)/o;return n===!0&&(c<0||c>1)?null:t.copy(e.start).addScaledVector(s,c)}intersectsLine(e){let t=this.distanceToPoint(e.start),n=this.distanceToPoint(e.end);return t<0&&n>0||n<0&&t>0}intersectsBox(e){return e.intersectsPlane(this)}intersectsSphere(e){return e.intersectsPlane(this)}coplanarPoint(e){return e.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(e,t){let n=t||X0.getNormalMatrix(e),s=this.coplanarPoint(Yl).applyMatrix4(e),o=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(o),this}translate(e){return this.constant-=e.dot(this.normal),this}equals(e){return e.normal.equals(this.normal)&&e.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(e){return this.normal.fromArray(e.normal),this.constant=e.constant,this}},$0=0,vi=class extends ti{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:$0++}),this.uuid=Wr(),this.name="",this.type="Material",this.blending=Gr,this.side=Oi,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=uc,this.blendDst=dc,this.blendEquation=rr,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new ut(0,0,0),this.blendAlpha=0,this.depthFunc=Cr,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=Zu,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=Fa,this.stencilZFail=Fa,this.stencilZPass=Fa,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(e){this._alphaTest>0!=e>0&&this.version++,this._alphaTest=e}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(e){if(e!==void 0)for(let t in e){let n=e[t];if(n===void 0){Qe(`Material: parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){Qe(`Material: '${t}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector2&&n&&n.isVector2||s&&s.isEuler&&n&&n.isEuler||s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";t&&(e={textures:{},images:{}});let n={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,n.blending=this.blending,n.side=this.side,n.shadowSide=this.shadowSide,n.vertexColors=this.vertexColors,n.opacity=this.opacity,n.transparent=this.transparent,n.blendSrc=this.blendSrc,n.blendDst=this.blendDst,n.blendEquation=this.blendEquation,n.blendSrcAlpha=this.blendSrcAlpha,n.blendDstAlpha=this.blendDstAlpha,n.blendEquationAlpha=this.blendEquationAlpha,n.blendColor=this.blendColor.getHex(),n.blendAlpha=this.blendAlpha,n.depthFunc=this.depthFunc,n.depthTest=this.depthTest,n.depthWrite=this.depthWrite,n.colorWrite=this.colorWrite,n.clipIntersection=this.clipIntersection,n.clipShadows=this.clipShadows,n.stencilWriteMask=this.stencilWriteMask,n.stencilFunc=this.stencilFunc,n.stencilRef=this.stencilRef,n.stencilFuncMask=this.stencilFuncMask,n.stencilFail=this.stencilFail,n.stencilZFail=this.stencilZFail,n.stencilZPass=this.stencilZPass,n.stencilWrite=this.stencilWrite,n.polygonOffset=this.polygonOffset,n.polygonOffsetFactor=this.polygonOffsetFactor,n.polygonOffsetUnits=this.polygonOffsetUnits,n.dithering=this.dithering,n.alphaTest=this.alphaTest,n.alphaHash=this.alphaHash,n.alphaToCoverage=this.alphaToCoverage,n.premultipliedAlpha=this.premultipliedAlpha,n.forceSinglePass=this.forceSinglePass,n.allowOverride=this.allowOverride,n.visible=this.visible,n.toneMapped=this.toneMapped,n.name=this.name,this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(n.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(n.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(e).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(e).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(e).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(e).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(n.sheenColorMap=this.sheenColorMap.toJSON(e).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(n.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(e).uuid),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(n.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(n.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(n.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(e).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(e).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(e).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(e).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(e).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(e).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(e).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(e).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(e).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(e).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(e).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(e).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(e).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(e).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(e).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(e).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(e).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(e).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(e).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(e).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(e).uuid),this.attenuationDistance!==void 0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(n.clippingPlanes=this.clippingPlanes.map(o=>o.toJSON())),this.rotation!==void 0&&(n.rotation=this.rotation),this.depthPacking!==void 0&&(n.depthPacking=this.depthPacking),this.linewidth!==void 0&&(n.linewidth=this.linewidth),this.linecap!==void 0&&(n.linecap=this.linecap),this.linejoin!==void 0&&(n.linejoin=this.linejoin),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.wireframe!==void 0&&(n.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(n.flatShading=this.flatShading),this.fog!==void 0&&(n.fog=this.fog),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(o){let c=[];for(let h in o){let d=o[h];delete d.metadata,c.push(d)}return c}if(t){let o=s(e.textures),c=s(e.images);o.length>0&&(n.textures=o),c.length>0&&(n.images=c)}return n}fromJSON(e,t){if(e.uuid!==void 0&&(this.uuid=e.uuid),e.name!==void 0&&(this.name=e.name),e.color!==void 0&&this.color!==void 0&&this.color.setHex(e.color),e.roughness!==void 0&&(this.roughness=e.roughness),e.metalness!==void 0&&(this.metalness=e.metalness),e.sheen!==void 0&&(this.sheen=e.sheen),e.sheenColor!==void 0&&(this.sheenColor=new ut().setHex(e.sheenColor)),e.sheenRoughness!==void 0&&(this.sheenRoughness=e.sheenRoughness),e.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(e.emissive),e.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(e.specular),e.specularIntensity!==void 0&&(this.specularIntensity=e.specularIntensity),e.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(e.specularColor),e.shininess!==void 0&&(this.shininess=e.shininess),e.clearcoat!==void 0&&(this.clearcoat=e.clearcoat),e.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=e.clearcoatRoughness),e.diffuseRoughness!==void 0&&(this.diffuseRoughness=e.diffuseRoughness),e.dispersion!==void 0&&(this.dispersion=e.dispersion),e.retroreflectivity!==void 0&&(this.retroreflectivity=e.retroreflectivity),e.iridescence!==void 0&&(this.iridescence=e.iridescence),e.iridescenceIOR!==void 0&&(this.iridescenceIOR=e.iridescenceIOR),e.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessMinimum),e.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=e.iridescenceThicknessMaximum),e.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=e.iridescenceThicknessRange[1]),e.transmission!==void 0&&(this.transmission=e.transmission),e.thickness!==void 0&&(this.thickness=e.thickness),e.attenuationDistance!==void 0&&(this.attenuationDistance=e.attenuationDistance),e.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(e.attenuationColor),e.anisotropy!==void 0&&(this.anisotropy=e.anisotropy),e.anisotropyRotation!==void 0&&(this.anisotropyRotation=e.anisotropyRotation),e.fog!==void 0&&(this.fog=e.fog),e.flatShading!==void 0&&(this.flatShading=e.flatShading),e.blending!==void 0&&(this.blending=e.blending),e.combine!==void 0&&(this.combine=e.combine),e.side!==void 0&&(this.side=e.side),e.shadowSide!==void 0&&(this.shadowSide=e.shadowSide),e.opacity!==void 0&&(this.opacity=e.opacity),e.transparent!==void 0&&(this.transparent=e.transparent),e.alphaTest!==void 0&&(this.alphaTest=e.alphaTest),e.alphaHash!==void 0&&(this.alphaHash=e.alphaHash),e.depthFunc!==void 0&&(this.depthFunc=e.depthFunc),e.depthTest!==void 0&&(this.depthTest=e.depthTest),e.depthWrite!==void 0&&(this.depthWrite=e.depthWrite),e.colorWrite!==void 0&&(this.colorWrite=e.colorWrite),e.clippingPlanes!==void 0&&(this.clippingPlanes=e.clippingPlanes.map(n=>new kn().fromJSON(n))),e.clipIntersection!==void 0&&(this.clipIntersection=e.clipIntersection),e.clipShadows!==void 0&&(this.clipShadows=e.clipShadows),e.depthPacking!==void 0&&(this.depthPacking=e.depthPacking),e.blendSrc!==void 0&&(this.blendSrc=e.blendSrc),e.blendDst!==void 0&&(this.blendDst=e.blendDst),e.blendEquation!==void 0&&(this.blendEquation=e.blendEquation),e.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=e.blendSrcAlpha),e.blendDstAlpha!==void 0&&(this.blendDstAlpha=e.blendDstAlpha),e.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=e.blendEquationAlpha),e.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(e.blendColor),e.blendAlpha!==void 0&&(this.blendAlpha=e.blendAlpha),e.stencilWriteMask!==void 0&&(this.stencilWriteMask=e.stencilWriteMask),e.stencilFunc!==void 0&&(this.stencilFunc=e.stencilFunc),e.stencilRef!==void 0&&(this.stencilRef=e.stencilRef),e.stencilFuncMask!==void 0&&(this.stencilFuncMask=e.stencilFuncMask),e.stencilFail!==void 0&&(this.stencilFail=e.stencilFail),e.stencilZFail!==void 0&&(this.stencilZFail=e.stencilZFail),e.stencilZPass!==void 0&&(this.stencilZPass=e.stencilZPass),e.stencilWrite!==void 0&&(this.stencilWrite=e.stencilWrite),e.wireframe!==void 0&&(this.wireframe=e.wireframe),e.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=e.wireframeLinewidth),e.wireframeLinecap!==void 0&&(this.wireframeLinecap=e.wireframeLinecap),e.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=e.wireframeLinejoin),e.rotation!==void 0&&(this.rotation=e.rotation),e.linewidth!==void 0&&(this.linewidth=e.linewidth),e.linecap!==void 0&&(this.linecap=e.linecap),e.linejoin!==void 0&&(this.linejoin=e.linejoin),e.dashSize!==void 0&&(this.dashSize=e.dashSize),e.gapSize!==void 0&&(this.gapSize=e.gapSize),e.scale!==void 0&&(this.scale=e.scale),e.polygonOffset!==void 0&&(this.polygonOffset=e.polygonOffset),e.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=e.polygonOffsetFactor),e.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=e.polygonOffsetUnits),e.dithering!==void 0&&(this.dithering=e.dithering),e.alphaToCoverage!==void 0&&(this.alphaToCoverage=e.alphaToCoverage),e.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=e.premultipliedAlpha),e.forceSinglePass!==void 0&&(this.forceSinglePass=e.forceSinglePass),e.allowOverride!==void 0&&(this.allowOverride=e.allowOverride),e.visible!==void 0&&(this.visible=e.visible),e.toneMapped!==void 0&&(this.toneMapped=e.toneMapped),e.userData!==void 0&&(this.userData=e.userData),e.vertexColors!==void 0&&(typeof e.vertexColors=="number"?this.vertexColors=e.vertexColors>0:this.vertexColors=e.vertexColors),e.size!==void 0&&(this.size=e.size),e.sizeAttenuation!==void 0&&(this.sizeAttenuation=e.sizeAttenuation),e.map!==void 0&&(this.map=t[e.map]||null),e.matcap!==void 0&&(this.matcap=t[e.matcap]||null),e.alphaMap!==void 0&&(this.alphaMap=t[e.alphaMap]||null),e.bumpMap!==void 0&&(this.bumpMap=t[e.bumpMap]||null),e.bumpScale!==void 0&&(this.bumpScale=e.bumpScale),e.normalMap!==void 0&&(this.normalMap=t[e.normalMap]||null),e.normalMapType!==void 0&&(this.normalMapType=e.normalMapType),e.normalScale!==void 0){let n=e.normalScale;Array.isArray(n)===!1&&(n=[n,n]),this.normalScale=new gt().fromArray(n)}return e.displacementMap!==void 0&&(this.displacementMap=t[e.displacementMap]||null),e.displacementScale!==void 0&&(this.displacementScale=e.displacementScale),e.displacementBias!==void 0&&(this.displacementBias=e.displacementBias),e.roughnessMap!==void 0&&(this.roughnessMap=t[e.roughnessMap]||null),e.metalnessMap!==void 0&&(this.metalnessMap=t[e.metalnessMap]||null),e.emissiveMap!==void 0&&(this.emissiveMap=t[e.emissiveMap]||null),e.emissiveIntensity!==void 0&&(this.emissiveIntensity=e.emissiveIntensity),e.specularMap!==void 0&&(this.specularMap=t[e.specularMap]||null),e.specularIntensityMap!==void 0&&(this.specularIntensityMap=t[e.specularIntensityMap]||null),e.specularColorMap!==void 0&&(this.specularColorMap=t[e.specularColorMap]||null),e.envMap!==void 0&&(this.envMap=t[e.envMap]||null),e.envMapRotation!==void 0&&this.envMapRotation.fromArray(e.envMapRotation),e.envMapIntensity!==void 0&&(this.envMapIntensity=e.envMapIntensity),e.reflectivity!==void 0&&(this.reflectivity=e.reflectivity),e.refractionRatio!==void 0&&(this.refractionRatio=e.refractionRatio),e.lightMap!==void 0&&(this.lightMap=t[e.lightMap]||null),e.lightMapIntensity!==void 0&&(this.lightMapIntensity=e.lightMapIntensity),e.aoMap!==void 0&&(this.aoMap=t[e.aoMap]||null),e.aoMapIntensity!==void 0&&(this.aoMapIntensity=e.aoMapIntensity),e.gradientMap!==void 0&&(this.gradientMap=t[e.gradientMap]||null),e.clearcoatMap!==void 0&&(this.clearcoatMap=t[e.clearcoatMap]||null),e.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=t[e.clearcoatRoughnessMap]||null),e.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=t[e.clearcoatNormalMap]||null),e.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new gt().fromArray(e.clearcoatNormalScale)),e.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=t[e.diffuseRoughnessMap]||null),e.iridescenceMap!==void 0&&(this.iridescenceMap=t[e.iridescenceMap]||null),e.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=t[e.iridescenceThicknessMap]||null),e.transmissionMap!==void 0&&(this.transmissionMap=t[e.transmissionMap]||null),e.thicknessMap!==void 0&&(this.thicknessMap=t[e.thicknessMap]||null),e.anisotropyMap!==void 0&&(this.anisotropyMap=t[e.anisotropyMap]||null),e.sheenColorMap!==void 0&&(this.sheenColorMap=t[e.sheenColorMap]||null),e.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=t[e.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(e){this.name=e.name,this.blending=e.blending,this.side=e.side,this.vertexColors=e.vertexColors,this.opacity=e.opacity,this.transparent=e.transparent,this.blendSrc=e.blendSrc,this.blendDst=e.blendDst,this.blendEquation=e.blendEquation,this.blendSrcAlpha=e.blendSrcAlpha,this.blendDstAlpha=e.blendDstAlpha,this.blendEquationAlpha=e.blendEquationAlpha,this.blendColor.copy(e.blendColor),this.blendAlpha=e.blendAlpha,this.depthFunc=e.depthFunc,this.depthTest=e.depthTest,this.depthWrite=e.depthWrite,this.stencilWriteMask=e.stencilWriteMask,this.stencilFunc=e.stencilFunc,this.stencilRef=e.stencilRef,this.stencilFuncMask=e.stencilFuncMask,this.stencilFail=e.stencilFail,this.stencilZFail=e.stencilZFail,this.stencilZPass=e.stencilZPass,this.stencilWrite=e.stencilWrite;let t=e.clippingPlanes,n=null;if(t!==null){let s=t.length;n=new Array(s);for(let o=0;o!==s;++o)n[o]=t[o].clone()}return this.clippingPlanes=n,this.clipIntersection=e.clipIntersection,this.clipShadows=e.clipShadows,this.shadowSide=e.shadowSide,this.colorWrite=e.colorWrite,this.precision=e.precision,this.polygonOffset=e.polygonOffset,this.polygonOffsetFactor=e.polygonOffsetFactor,this.polygonOffsetUnits=e.polygonOffsetUnits,this.dithering=e.dithering,this.alphaTest=e.alphaTest,this.alphaHash=e.alphaHash,this.alphaToCoverage=e.alphaToCoverage,this.premultipliedAlpha=e.premultipliedAlpha,this.forceSinglePass=e.forceSinglePass,this.allowOverride=e.allowOverride,this.visible=e.visible,this.toneMapped=e.toneMapped,this.userData=JSON.parse(JSON.stringify(e.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(e){e===!0&&this.version++}};var pi=new Q,jl=new Q,va=new Q,ya=new Q,Nr=class{constructor(e=new Q,t=new Q(0,0,-1)){this.origin=e,this.direction=t}set(e,t){return this.origin.copy(e),this.direction.copy(t),this}copy(e){return this.origin.copy(e.origin),this.direction.copy(e.direction),this}at(e,t){return t.copy(this.origin).addScaledVector(this.direction,e)}lookAt(e){return this.direction.copy(e).sub(this.origin).normalize(),this}recast(e){return this.origin.copy(this.at(e,pi)),this}closestPointToPoint(e,t){t.subVectors(e,this.origin);let n=t.dot(this.direction);return n<0?t.copy(this.origin):t.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(e){return Math.sqrt(this.distanceSqToPoint(e))}distanceSqToPoint(e){let t=pi.subVectors(e,this.origin).dot(this.direction);return t<0?this.origin.distanceToSquared(e):(pi.copy(this.origin).addScaledVector(this.direction,t),pi.distanceToSquared(e))}distanceSqToSegment(e,t,n,s){jl.copy(e).add(t).multiplyScalar(.5),va.copy(t).sub(e).normalize(),ya.copy(this.origin).sub(jl);let o=e.distanceTo(t)*.5,c=-this.direction.dot(va),h=ya.dot(this.direction),d=-ya.dot(va),f=ya.lengthSq(),p=Math.abs(1-c*c),_,g,S,w;if(p>0)if(_=c*d-h,g=c*h-d,w=o*p,_>=0)if(g>=-w)if(g<=w){let R=1/p;_*=R,g*=R,S=_*(_+c*g+2*h)+g*(c*_+g+2*d)+f}else g=o,_=Math.max(0,-(c*g+h)),S=-_*_+g*(g+2*d)+f;else g=-o,_=Math.max(0,-(c*g+h)),S=-_*_+g*(g+2*d)+f;else g<=-w?(_=Math.max(0,-(-c*o+h)),g=_>0?-o:Math.min(Math.max(-o,-d),o),S=-_*_+g*(g+2*d)+f):g<=w?(_=0,g=Math.min(Math.max(-o,-d),o),S=g*(g+2*d)+f):(_=Math.max(0,-(c*o+h)),g=_>0?o:Math.min(Math.max(-o,-d),o),S=-_*_+g*(g+2*d)+f);else g=c>0?-o:o,_=Math.max(0,-(c*g+h)),S=-_*_+g*(g+2*d)+f;return n&&n.copy(this.origin).addScaledVector(this.direction,_),s&&s.copy(jl).addScaledVector(va,g),S}intersectSphere(e,t){if(e.radius<0)return null;pi.subVectors(e.center,this.origin);let n=pi.dot(this.direction),s=pi.dot(pi)-n*n,o=e.radius*e.radius;if(s>o)return null;let c=Math.sqrt(o-s),h=n-c,d=n+c;return d<0?null:h<0?this.at(d,t):this.at(h,t)}intersectsSphere(e){return e.radius<0?!1:this.distanceSqToPoint(e.center)<=e.radius*e.radius}distanceToPlane(e){let t=e.normal.dot(this.direction);if(t===0)return e.distanceToPoint(this.origin)===0?0:null;let n=-(this.origin.dot(e.normal)+e.constant)/t;return n>=0?n:null}intersectPlane(e,t){let n=this.distanceToPlane(e);return n===null?null:this.at(n,t)}intersectsPlane(e){let t=e.distanceToPoint(this.origin);return t===0||e.normal.dot(this.direction)*t<0}intersectBox(e,t){let n,s,o,c,h,d,f=1/this.direction.x,p=1/this.direction.y,_=1/this.direction.z,g=this.origin;return f>=0?(n=(e.min.x-g.x)*f,s=(e.max.x-g.x)*f):(n=(e.max.x-g.x)*f,s=(e.min.x-g.x)*f),p>=0?(o=(e.min.y-g.y)*p,c=(e.max.y-g.y)*p):(o=(e.max.y-g.y)*p,c=(e.min.y-g.y)*p),n>c||o>s||((o>n||isNaN(n))&&(n=o),(c<s||isNaN(s))&&(s=c),_>=0?(h=(e.min.z-g.z)*_,d=(e.max.z-g.z)*_):(h=(e.max.z-g.z)*_,d=(e.min.z-g.z)*_),n>d||h>s)||((h>n||n!==n)&&(n=h),(d<s||s!==s)&&(s=d),s<0)?null:this.at(n>=0?n:s,t)}intersectsBox(e){return this.intersectBox(e,pi)!==null}intersectTriangle(e,t,n,s,o){let c=this.origin,h=this.direction,d=h.x,f=h.y,p=h.z,_=e.x-c.x,g=e.y-c.y,S=e.z-c.z,w=t.x-c.x,R=t.y-c.y,x=t.z-c.z,y=n.x-c.x,P=n.y-c.y,U=n.z-c.z,I=Math.abs(d),O=Math.abs(f),N=Math.abs(p),b,L,q,k,Y,J,ee,z,ie,G,ne,Se;if(I>=O&&I>=N?(q=d,J=_,ie=w,Se=y,d>=0?(b=f,L=p,k=g,Y=S,ee=R,z=x,G=P,ne=U):(b=p,L=f,k=S,Y=g,ee=x,z=R,G=U,ne=P)):O>=N?(q=f,J=g,ie=R,Se=P,f>=0?(b=p,L=d,k=S,Y=_,ee=x,z=w,G=U,ne=y):(b=d,L=p,k=_,Y=S,ee=w,z=x,G=y,ne=U)):(q=p,J=S,ie=x,Se=U,p>=0?(b=d,L=f,k=_,Y=g,ee=w,z=R,G=y,ne=P):(b=f,L=d,k=g,Y=_,ee=R,z=w,G=P,ne=y)),q===0)return null;let re=b/q,H=L/q,me=1/q,Xe=k-re*J,nt=Y-H*J,ue=ee-re*ie,Fe=z-H*ie,Pe=G-re*Se,je=ne-H*Se,Ue=Pe*Fe-je*ue,rt=Xe*je-nt*Pe,Gt=ue*nt-Fe*Xe;if(s){if(Ue<0||rt<0||Gt<0)return null}else if((Ue<0||rt<0||Gt<0)&&(Ue>0||rt>0||Gt>0))return null;let et=Ue+rt+Gt;if(et===0)return null;let wt=me*(Ue*J+rt*ie+Gt*Se);return(et>0?wt<0:wt>0)?null:this.at(wt/et,o)}applyMatrix4(e){return this.origin.applyMatrix4(e),this.direction.transformDirection(e),this}equals(e){return e.origin.equals(this.origin)&&e.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},Ya=class extends vi{constructor(e){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new ut(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new _i,this.combine=fc,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.fog=e.fog,this}},lu=new It,Zi=new Nr,xa=new er,cu=new Q,Sa=new Q,Ma=new Q,ba=new Q,Jl=new Q,wa=new Q,hu=new Q,Ea=new Q,Ln=class extends ln{constructor(e=new vn,t=new Ya){super(),this.isMesh=!0,this.type="Mesh",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let o=0,c=s.length;o<c;o++){let h=s[o].name||String(o);this.morphTargetInfluences.push(0),this.morphTargetDictionary[h]=o}}}}getVertexPosition(e,t){let n=this.geometry,s=n.attributes.position,o=n.morphAttributes.position,c=n.morphTargetsRelative;t.fromBufferAttribute(s,e);let h=this.morphTargetInfluences;if(o&&h){wa.set(0,0,0);for(let d=0,f=o.length;d<f;d++){let p=h[d],_=o[d];p!==0&&(Jl.fromBufferAttribute(_,e),c?wa.addScaledVector(Jl,p):wa.addScaledVector(Jl.sub(t),p))}t.add(wa)}return t}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.material,o=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),xa.copy(n.boundingSphere),xa.applyMatrix4(o),Zi.copy(e.ray).recast(e.near),!(xa.containsPoint(Zi.origin)===!1&&(Zi.intersectSphere(xa,cu)===null||Zi.origin.distanceToSquared(cu)>(e.far-e.near)**2))&&(lu.copy(o).invert(),Zi.copy(e.ray).applyMatrix4(lu),!(n.boundingBox!==null&&Zi.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(e,t,Zi)))}_computeIntersections(e,t,n){let s,o=this.geometry,c=this.material,h=o.index,d=o.attributes.position,f=o.attributes.uv,p=o.attributes.uv1,_=o.attributes.normal,g=o.groups,S=o.drawRange;if(h!==null)if(Array.isArray(c))for(let w=0,R=g.length;w<R;w++){let x=g[w],y=c[x.materialIndex],P=Math.max(x.start,S.start),U=Math.min(h.count,Math.min(x.start+x.count,S.start+S.count));for(let I=P,O=U;I<O;I+=3){let N=h.getX(I),b=h.getX(I+1),L=h.getX(I+2);s=Ta(this,y,e,n,f,p,_,N,b,L),s&&(s.faceIndex=Math.floor(I/3),s.face.materialIndex=x.materialIndex,t.push(s))}}else{let w=Math.max(0,S.start),R=Math.min(h.count,S.start+S.count);for(let x=w,y=R;x<y;x+=3){let P=h.getX(x),U=h.getX(x+1),I=h.getX(x+2);s=Ta(this,c,e,n,f,p,_,P,U,I),s&&(s.faceIndex=Math.floor(x/3),t.push(s))}}else if(d!==void 0)if(Array.isArray(c))for(let w=0,R=g.length;w<R;w++){let x=g[w],y=c[x.materialIndex],P=Math.max(x.start,S.start),U=Math.min(d.count,Math.min(x.start+x.count,S.start+S.count));for(let I=P,O=U;I<O;I+=3){let N=I,b=I+1,L=I+2;s=Ta(this,y,e,n,f,p,_,N,b,L),s&&(s.faceIndex=Math.floor(I/3),s.face.materialIndex=x.materialIndex,t.push(s))}}else{let w=Math.max(0,S.start),R=Math.min(d.count,S.start+S.count);for(let x=w,y=R;x<y;x+=3){let P=x,U=x+1,I=x+2;s=Ta(this,c,e,n,f,p,_,P,U,I),s&&(s.faceIndex=Math.floor(x/3),t.push(s))}}}};function q0(i,e,t,n,s,o,c,h){let d;if(e.side===yn?d=n.intersectTriangle(c,o,s,!0,h):d=n.intersectTriangle(s,o,c,e.side===Oi,h),d===null)return null;Ea.copy(h),Ea.applyMatrix4(i.matrixWorld);let f=t.ray.origin.distanceTo(Ea);return f<t.near||f>t.far?null:{distance:f,point:Ea.clone(),object:i}}function Ta(i,e,t,n,s,o,c,h,d,f){i.getVertexPosition(h,Sa),i.getVertexPosition(d,Ma),i.getVertexPosition(f,ba);let p=q0(i,e,t,n,Sa,Ma,ba,hu);if(p){let _=new Q;Pi.getBarycoord(hu,Sa,Ma,ba,_),s&&(p.uv=Pi.getInterpolatedAttribute(s,h,d,f,_,new gt)),o&&(p.uv1=Pi.getInterpolatedAttribute(o,h,d,f,_,new gt)),c&&(p.normal=Pi.getInterpolatedAttribute(c,h,d,f,_,new Q),p.normal.dot(n.direction)>0&&p.normal.multiplyScalar(-1));let g={a:h,b:d,c:f,normal:new Q,materialIndex:0};Pi.getNormal(Sa,Ma,ba,g.normal),p.face=g,p.barycoord=_}return p}var ja=class extends xn{constructor(e=null,t=1,n=1,s,o,c,h,d,f=sn,p=sn,_,g){super(null,c,h,d,f,p,s,o,_,g),this.isDataTexture=!0,this.image={data:e,width:t,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var Ki=new er,Y0=new gt(.5,.5),Aa=new Q,Li=class{constructor(e=new kn,t=new kn,n=new kn,s=new kn,o=new kn,c=new kn){this.planes=[e,t,n,s,o,c]}set(e,t,n,s,o,c){let h=this.planes;return h[0].copy(e),h[1].copy(t),h[2].copy(n),h[3].copy(s),h[4].copy(o),h[5].copy(c),this}copy(e){let t=this.planes;for(let n=0;n<6;n++)t[n].copy(e.planes[n]);return this}setFromProjectionMatrix(e,t=In,n=!1){let s=this.planes,o=e.elements,c=o[0],h=o[1],d=o[2],f=o[3],p=o[4],_=o[5],g=o[6],S=o[7],w=o[8],R=o[9],x=o[10],y=o[11],P=o[12],U=o[13],I=o[14],O=o[15];if(s[0].setComponents(f-c,S-p,y-w,O-P).normalize(),s[1].setComponents(f+c,S+p,y+w,O+P).normalize(),s[2].setComponents(f+h,S+_,y+R,O+U).normalize(),s[3].setComponents(f-h,S-_,y-R,O-U).normalize(),n)s[4].setComponents(d,g,x,I).normalize(),s[5].setComponents(f-d,S-g,y-x,O-I).normalize();else if(s[4].setComponents(f-d,S-g,y-x,O-I).normalize(),t===In)s[5].setComponents(f+d,S+g,y+x,O+I).normalize();else if(t===Rr)s[5].setComponents(d,g,x,I).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+t);return this}intersectsObject(e){if(e.boundingSphere!==void 0)e.boundingSphere===null&&e.computeBoundingSphere(),Ki.copy(e.boundingSphere).applyMatrix4(e.matrixWorld);else{let t=e.geometry;t.boundingSphere===null&&t.computeBoundingSphere(),Ki.copy(t.boundingSphere).applyMatrix4(e.matrixWorld)}return this.intersectsSphere(Ki)}intersectsSprite(e){Ki.center.set(0,0,0);let t=Y0.distanceTo(e.center);return Ki.radius=.7071067811865476+t,Ki.applyMatrix4(e.matrixWorld),this.intersectsSphere(Ki)}intersectsSphere(e){let t=this.planes,n=e.center,s=-e.radius;for(let o=0;o<6;o++)if(t[o].distanceToPoint(n)<s)return!1;return!0}intersectsBox(e){let t=this.planes;for(let n=0;n<6;n++){let s=t[n];if(Aa.x=s.normal.x>0?e.max.x:e.min.x,Aa.y=s.normal.y>0?e.max.y:e.min.y,Aa.z=s.normal.z>0?e.max.z:e.min.z,s.distanceToPoint(Aa)<0)return!1}return!0}containsPoint(e){let t=this.planes;for(let n=0;n<6;n++)if(t[n].distanceToPoint(e)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},uu=new It,Ja=class i{constructor(){this.coordinateSystem=In,this._frustums=[],this._count=0}setFromArrayCamera(e){let t=e.cameras,n=this._frustums;for(let s=0;s<t.length;s++){let o=t[s];uu.multiplyMatrices(o.projectionMatrix,o.matrixWorldInverse),n[s]===void 0&&(n[s]=new Li),n[s].setFromProjectionMatrix(uu,o.coordinateSystem,o.reversedDepth)}return this._count=t.length,this}getFrustum(e){return this._frustums[e]}intersectsObject(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsObject(e))return!0;return!1}intersectsSprite(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSprite(e))return!0;return!1}intersectsSphere(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSphere(e))return!0;return!1}intersectsBox(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsBox(e))return!0;return!1}containsPoint(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].containsPoint(e))return!0;return!1}copy(e){this.coordinateSystem=e.coordinateSystem;let t=this._frustums,n=e._frustums;for(let s=0;s<e._count;s++)t[s]===void 0&&(t[s]=new Li),t[s].copy(n[s]);return this._count=e._count,this}clone(){return new i().copy(this)}};var tr=class extends vi{constructor(e){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new ut(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.linewidth=e.linewidth,this.linecap=e.linecap,this.linejoin=e.linejoin,this.fog=e.fog,this}},Za=new Q,Ka=new Q,du=new It,ss=new Nr,Ca=new er,Zl=new Q,fu=new Q,Ur=class extends ln{constructor(e=new vn,t=new tr){super(),this.isLine=!0,this.type="Line",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[0];for(let s=1,o=t.count;s<o;s++)Za.fromBufferAttribute(t,s-1),Ka.fromBufferAttribute(t,s),n[s]=n[s-1],n[s]+=Za.distanceTo(Ka);e.setAttribute("lineDistance",new Wt(n,1))}else Qe("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.matrixWorld,o=e.params.Line.threshold,c=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),Ca.copy(n.boundingSphere),Ca.applyMatrix4(s),Ca.radius+=o,e.ray.intersectsSphere(Ca)===!1)return;du.copy(s).invert(),ss.copy(e.ray).applyMatrix4(du);let h=o/((this.scale.x+this.scale.y+this.scale.z)/3),d=h*h,f=this.isLineSegments?2:1,p=n.index,g=n.attributes.position;if(p!==null){let S=Math.max(0,c.start),w=Math.min(p.count,c.start+c.count);for(let R=S,x=w-1;R<x;R+=f){let y=p.getX(R),P=p.getX(R+1),U=Ra(this,e,ss,d,y,P,R);U&&t.push(U)}if(this.isLineLoop){let R=p.getX(w-1),x=p.getX(S),y=Ra(this,e,ss,d,R,x,w-1);y&&t.push(y)}}else{let S=Math.max(0,c.start),w=Math.min(g.count,c.start+c.count);for(let R=S,x=w-1;R<x;R+=f){let y=Ra(this,e,ss,d,R,R+1,R);y&&t.push(y)}if(this.isLineLoop){let R=Ra(this,e,ss,d,w-1,S,w-1);R&&t.push(R)}}}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let o=0,c=s.length;o<c;o++){let h=s[o].name||String(o);this.morphTargetInfluences.push(0),this.morphTargetDictionary[h]=o}}}}};function Ra(i,e,t,n,s,o,c){let h=i.geometry.attributes.position;if(Za.fromBufferAttribute(h,s),Ka.fromBufferAttribute(h,o),t.distanceSqToSegment(Za,Ka,Zl,fu)>n)return;Zl.applyMatrix4(i.matrixWorld);let f=e.ray.origin.distanceTo(Zl);if(!(f<e.near||f>e.far))return{distance:f,point:fu.clone().applyMatrix4(i.matrixWorld),index:c,face:null,faceIndex:null,barycoord:null,object:i}}var pu=new Q,mu=new Q,_s=class extends Ur{constructor(e,t){super(e,t),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[];for(let s=0,o=t.count;s<o;s+=2)pu.fromBufferAttribute(t,s),mu.fromBufferAttribute(t,s+1),n[s]=s===0?0:n[s-1],n[s+1]=n[s]+pu.distanceTo(mu);e.setAttribute("lineDistance",new Wt(n,1))}else Qe("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var vs=class extends xn{constructor(e=[],t=sr,n,s,o,c,h,d,f,p){super(e,t,n,s,o,c,h,d,f,p),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(e){this.image=e}};var yi=class extends xn{constructor(e,t,n=zn,s,o,c,h=sn,d=sn,f,p=gi,_=1){if(p!==gi&&p!==Si)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let g={width:e,height:t,depth:_};super(g,s,o,c,h,d,p,n,f),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(e){return super.copy(e),this.source=new Lr(Object.assign({},e.image)),this.compareFunction=e.compareFunction,this}toJSON(e){let t=super.toJSON(e);return t.compareFunction=this.compareFunction,t}},ys=class extends yi{constructor(e,t=zn,n=sr,s,o,c=sn,h=sn,d,f=gi){let p={width:e,height:e,depth:1},_=[p,p,p,p,p,p];super(e,e,t,n,s,o,c,h,d,f),this.image=_,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(e){this.image=e}},xs=class extends xn{constructor(e=null){super(),this.sourceTexture=e,this.isExternalTexture=!0}copy(e){return super.copy(e),this.sourceTexture=e.sourceTexture,this}},Di=class i extends vn{constructor(e=1,t=1,n=1,s=1,o=1,c=1){super(),this.type="BoxGeometry",this.parameters={width:e,height:t,depth:n,widthSegments:s,heightSegments:o,depthSegments:c};let h=this;s=Math.floor(s),o=Math.floor(o),c=Math.floor(c);let d=[],f=[],p=[],_=[],g=0,S=0;w("z","y","x",-1,-1,n,t,e,c,o,0),w("z","y","x",1,-1,n,t,-e,c,o,1),w("x","z","y",1,1,e,n,t,s,c,2),w("x","z","y",1,-1,e,n,-t,s,c,3),w("x","y","z",1,-1,e,t,n,s,o,4),w("x","y","z",-1,-1,e,t,-n,s,o,5),this.setIndex(d),this.setAttribute("position",new Wt(f,3)),this.setAttribute("normal",new Wt(p,3)),this.setAttribute("uv",new Wt(_,2));function w(R,x,y,P,U,I,O,N,b,L,q){let k=I/b,Y=O/L,J=I/2,ee=O/2,z=N/2,ie=b+1,G=L+1,ne=0,Se=0,re=new Q;for(let H=0;H<G;H++){let me=H*Y-ee;for(let Xe=0;Xe<ie;Xe++){let nt=Xe*k-J;re[R]=nt*P,re[x]=me*U,re[y]=z,f.push(re.x,re.y,re.z),re[R]=0,re[x]=0,re[y]=N>0?1:-1,p.push(re.x,re.y,re.z),_.push(Xe/b),_.push(1-H/L),ne+=1}}for(let H=0;H<L;H++)for(let me=0;me<b;me++){let Xe=g+me+ie*H,nt=g+me+ie*(H+1),ue=g+(me+1)+ie*(H+1),Fe=g+(me+1)+ie*H;d.push(Xe,nt,Fe),d.push(nt,ue,Fe),Se+=6}h.addGroup(S,Se,q),S+=Se,g+=ne}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.width,e.height,e.depth,e.widthSegments,e.heightSegments,e.depthSegments)}},Ss=class i extends vn{constructor(e=1,t=1,n=4,s=8,o=1){super(),this.type="CapsuleGeometry",this.parameters={radius:e,height:t,capSegments:n,radialSegments:s,heightSegments:o},t=Math.max(0,t),n=Math.max(1,Math.floor(n)),s=Math.max(3,Math.floor(s)),o=Math.max(1,Math.floor(o));let c=[],h=[],d=[],f=[],p=t/2,_=Math.PI/2*e,g=t,S=2*_+g,w=n*2+o,R=s+1,x=new Q,y=new Q;for(let P=0;P<=w;P++){let U=0,I=0,O=0,N=0;if(P<=n){let q=P/n,k=q*Math.PI/2;I=-p-e*Math.cos(k),O=e*Math.sin(k),N=-e*Math.cos(k),U=q*_}else if(P<=n+o){let q=(P-n)/o;I=-p+q*t,O=e,N=0,U=_+q*g}else{let q=(P-n-o)/n,k=q*Math.PI/2;I=p+e*Math.sin(k),O=e*Math.cos(k),N=e*Math.sin(k),U=_+g+q*_}let b=Math.max(0,Math.min(1,U/S)),L=0;P===0?L=.5/s:P===w&&(L=-.5/s);for(let q=0;q<=s;q++){let k=q/s,Y=k*Math.PI*2,J=Math.sin(Y),ee=Math.cos(Y);y.x=-O*ee,y.y=I,y.z=O*J,h.push(y.x,y.y,y.z),x.set(-O*ee,N,O*J),x.normalize(),d.push(x.x,x.y,x.z),f.push(k+L,b)}if(P>0){let q=(P-1)*R;for(let k=0;k<s;k++){let Y=q+k,J=q+k+1,ee=P*R+k,z=P*R+k+1;c.push(Y,J,ee),c.push(J,z,ee)}}}this.setIndex(c),this.setAttribute("position",new Wt(h,3)),this.setAttribute("normal",new Wt(d,3)),this.setAttribute("uv",new Wt(f,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radius,e.height,e.capSegments,e.radialSegments,e.heightSegments)}};var Ms=class i extends vn{constructor(e=1,t=1,n=1,s=32,o=1,c=!1,h=0,d=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:e,radiusBottom:t,height:n,radialSegments:s,heightSegments:o,openEnded:c,thetaStart:h,thetaLength:d};let f=this;s=Math.floor(s),o=Math.floor(o);let p=[],_=[],g=[],S=[],w=0,R=[],x=n/2,y=0;P(),c===!1&&(e>0&&U(!0),t>0&&U(!1)),this.setIndex(p),this.setAttribute("position",new Wt(_,3)),this.setAttribute("normal",new Wt(g,3)),this.setAttribute("uv",new Wt(S,2));function P(){let I=new Q,O=new Q,N=0,b=(t-e)/n;for(let L=0;L<=o;L++){let q=[],k=L/o,Y=k*(t-e)+e;for(let J=0;J<=s;J++){let ee=J/s,z=ee*d+h,ie=Math.sin(z),G=Math.cos(z);O.x=Y*ie,O.y=-k*n+x,O.z=Y*G,_.push(O.x,O.y,O.z),I.set(ie,b,G).normalize(),g.push(I.x,I.y,I.z),S.push(ee,1-k),q.push(w++)}R.push(q)}for(let L=0;L<s;L++)for(let q=0;q<o;q++){let k=R[q][L],Y=R[q+1][L],J=R[q+1][L+1],ee=R[q][L+1];(e>0||q!==0)&&(p.push(k,Y,ee),N+=3),(t>0||q!==o-1)&&(p.push(Y,J,ee),N+=3)}f.addGroup(y,N,0),y+=N}function U(I){let O=w,N=new gt,b=new Q,L=0,q=I===!0?e:t,k=I===!0?1:-1;for(let J=1;J<=s;J++)_.push(0,x*k,0),g.push(0,k,0),S.push(.5,.5),w++;let Y=w;for(let J=0;J<=s;J++){let z=J/s*d+h,ie=Math.cos(z),G=Math.sin(z);b.x=q*G,b.y=x*k,b.z=q*ie,_.push(b.x,b.y,b.z),g.push(0,k,0),N.x=ie*.5+.5,N.y=G*.5*k+.5,S.push(N.x,N.y),w++}for(let J=0;J<s;J++){let ee=O+J,z=Y+J;I===!0?p.push(z,z+1,ee):p.push(z+1,z,ee),L+=3}f.addGroup(y,L,I===!0?1:2),y+=L}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radiusTop,e.radiusBottom,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}};var bs=class i extends vn{constructor(e=1,t=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:e,height:t,widthSegments:n,heightSegments:s};let o=e/2,c=t/2,h=Math.floor(n),d=Math.floor(s),f=h+1,p=d+1,_=e/h,g=t/d,S=[],w=[],R=[],x=[];for(let y=0;y<p;y++){let P=y*g-c;for(let U=0;U<f;U++){let I=U*_-o;w.push(I,-P,0),R.push(0,0,1),x.push(U/h),x.push(1-y/d)}}for(let y=0;y<d;y++)for(let P=0;P<h;P++){let U=P+f*y,I=P+f*(y+1),O=P+1+f*(y+1),N=P+1+f*y;S.push(U,I,N),S.push(I,O,N)}this.setIndex(S),this.setAttribute("position",new Wt(w,3)),this.setAttribute("normal",new Wt(R,3)),this.setAttribute("uv",new Wt(x,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.width,e.height,e.widthSegments,e.heightSegments)}};var Or=class i extends vn{constructor(e=1,t=32,n=16,s=0,o=Math.PI*2,c=0,h=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:e,widthSegments:t,heightSegments:n,phiStart:s,phiLength:o,thetaStart:c,thetaLength:h},t=Math.max(3,Math.floor(t)),n=Math.max(2,Math.floor(n));let d=Math.min(c+h,Math.PI),f=0,p=[],_=new Q,g=new Q,S=[],w=[],R=[],x=[];for(let y=0;y<=n;y++){let P=[],U=y/n,I=c+U*h,O=e*Math.cos(I),N=Math.sqrt(e*e-O*O),b=0;y===0&&c===0?b=.5/t:y===n&&d===Math.PI&&(b=-.5/t);for(let L=0;L<=t;L++){let q=L/t,k=s+q*o;_.x=-N*Math.cos(k),_.y=O,_.z=N*Math.sin(k),w.push(_.x,_.y,_.z),g.copy(_).normalize(),R.push(g.x,g.y,g.z),x.push(q+b,1-U),P.push(f++)}p.push(P)}for(let y=0;y<n;y++)for(let P=0;P<t;P++){let U=p[y][P+1],I=p[y][P],O=p[y+1][P],N=p[y+1][P+1];(y!==0||c>0)&&S.push(U,I,N),(y!==n-1||d<Math.PI)&&S.push(I,O,N)}this.setIndex(S),this.setAttribute("position",new Wt(w,3)),this.setAttribute("normal",new Wt(R,3)),this.setAttribute("uv",new Wt(x,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radius,e.widthSegments,e.heightSegments,e.phiStart,e.phiLength,e.thetaStart,e.thetaLength)}};function or(i){let e={};for(let t in i){e[t]={};for(let n in i[t]){let s=i[t][n];if(gu(s))s.isRenderTargetTexture?(Qe("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),e[t][n]=null):e[t][n]=s.clone();else if(Array.isArray(s))if(gu(s[0])){let o=[];for(let c=0,h=s.length;c<h;c++)o[c]=s[c].clone();e[t][n]=o}else e[t][n]=s.slice();else e[t][n]=s}}return e}function dn(i){let e={};for(let t=0;t<i.length;t++){let n=or(i[t]);for(let s in n)e[s]=n[s]}return e}function gu(i){return i&&(i.isColor||i.isMatrix3||i.isMatrix4||i.isVector2||i.isVector3||i.isVector4||i.isTexture||i.isQuaternion)}function j0(i){let e=[];for(let t=0;t<i.length;t++)e.push(i[t].clone());return e}function Oc(i){let e=i.getRenderTarget();return e===null?i.outputColorSpace:e.isXRRenderTarget===!0?e.texture.colorSpace:yt.workingColorSpace}var ud={clone:or,merge:dn},J0=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,Z0=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,ii=class extends vi{constructor(e){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=J0,this.fragmentShader=Z0,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,e!==void 0&&this.setValues(e)}copy(e){return super.copy(e),this.fragmentShader=e.fragmentShader,this.vertexShader=e.vertexShader,this.uniforms=or(e.uniforms),this.uniformsGroups=j0(e.uniformsGroups),this.defines=Object.assign({},e.defines),this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.fog=e.fog,this.lights=e.lights,this.clipping=e.clipping,this.extensions=Object.assign({},e.extensions),this.glslVersion=e.glslVersion,this.defaultAttributeValues=Object.assign({},e.defaultAttributeValues),this.index0AttributeName=e.index0AttributeName,this.uniformsNeedUpdate=e.uniformsNeedUpdate,this}toJSON(e){let t=super.toJSON(e);t.glslVersion=this.glslVersion,t.uniforms={};for(let s in this.uniforms){let c=this.uniforms[s].value;c&&c.isTexture?t.uniforms[s]={type:"t",value:c.toJSON(e).uuid}:c&&c.isColor?t.uniforms[s]={type:"c",value:c.getHex()}:c&&c.isVector2?t.uniforms[s]={type:"v2",value:c.toArray()}:c&&c.isVector3?t.uniforms[s]={type:"v3",value:c.toArray()}:c&&c.isVector4?t.uniforms[s]={type:"v4",value:c.toArray()}:c&&c.isMatrix3?t.uniforms[s]={type:"m3",value:c.toArray()}:c&&c.isMatrix4?t.uniforms[s]={type:"m4",value:c.toArray()}:t.uniforms[s]={value:c}}Object.keys(this.defines).length>0&&(t.defines=this.defines),t.vertexShader=this.vertexShader,t.fragmentShader=this.fragmentShader,t.lights=this.lights,t.clipping=this.clipping;let n={};for(let s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(t.extensions=n),t}fromJSON(e,t){if(super.fromJSON(e,t),e.uniforms!==void 0)for(let n in e.uniforms){let s=e.uniforms[n];switch(this.uniforms[n]={},s.type){case"t":this.uniforms[n].value=t[s.value]||null;break;case"c":this.uniforms[n].value=new ut().setHex(s.value);break;case"v2":this.uniforms[n].value=new gt().fromArray(s.value);break;case"v3":this.uniforms[n].value=new Q().fromArray(s.value);break;case"v4":this.uniforms[n].value=new zt().fromArray(s.value);break;case"m3":this.uniforms[n].value=new at().fromArray(s.value);break;case"m4":this.uniforms[n].value=new It().fromArray(s.value);break;default:this.uniforms[n].value=s.value}}if(e.defines!==void 0&&(this.defines=e.defines),e.vertexShader!==void 0&&(this.vertexShader=e.vertexShader),e.fragmentShader!==void 0&&(this.fragmentShader=e.fragmentShader),e.glslVersion!==void 0&&(this.glslVersion=e.glslVersion),e.extensions!==void 0)for(let n in e.extensions)this.extensions[n]=e.extensions[n];return e.lights!==void 0&&(this.lights=e.lights),e.clipping!==void 0&&(this.clipping=e.clipping),this}},Qa=class extends ii{constructor(e){super(e),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}},ws=class extends vi{constructor(e){super(),this.isMeshStandardMaterial=!0,this.type="MeshStandardMaterial",this.defines={STANDARD:""},this.color=new ut(16777215),this.roughness=1,this.metalness=0,this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new ut(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=el,this.normalScale=new gt(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.roughnessMap=null,this.metalnessMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new _i,this.envMapIntensity=1,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.defines={STANDARD:""},this.color.copy(e.color),this.roughness=e.roughness,this.metalness=e.metalness,this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.roughnessMap=e.roughnessMap,this.metalnessMap=e.metalnessMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.envMapIntensity=e.envMapIntensity,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}};var eo=class extends vi{constructor(e){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=ju,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(e)}copy(e){return super.copy(e),this.depthPacking=e.depthPacking,this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this}},to=class extends vi{constructor(e){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(e)}copy(e){return super.copy(e),this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this}};function wr(i,e){return!i||i.constructor===e?i:typeof e.BYTES_PER_ELEMENT=="number"?new e(i):Array.prototype.slice.call(i)}function Pa(i){return i!==void 0&&i.inTangents!==void 0&&i.outTangents!==void 0}var Fi=class{constructor(e,t,n,s){this.parameterPositions=e,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new t.constructor(n),this.sampleValues=t,this.valueSize=n,this.settings=null,this.DefaultSettings_={}}evaluate(e){let t=this.parameterPositions,n=this._cachedIndex,s=t[n],o=t[n-1];e:{t:{let c;n:{i:if(!(e<s)){for(let h=n+2;;){if(s===void 0){if(e<o)break i;return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}if(n===h)break;if(o=s,s=t[++n],e<s)break t}c=t.length;break n}if(!(e>=o)){let h=t[1];e<h&&(n=2,o=h);for(let d=n-2;;){if(o===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===d)break;if(s=o,o=t[--n-1],e>=o)break t}c=n,n=0;break n}break e}for(;n<c;){let h=n+c>>>1;e<t[h]?c=h:n=h+1}if(s=t[n],o=t[n-1],o===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}this._cachedIndex=n,this.intervalChanged_(n,o,s)}return this.interpolate_(n,o,e,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(e){let t=this.resultBuffer,n=this.sampleValues,s=this.valueSize,o=e*s;for(let c=0;c!==s;++c)t[c]=n[o+c];return t}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},no=class extends Fi{constructor(e,t,n,s){super(e,t,n,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:ec,endingEnd:ec}}intervalChanged_(e,t,n){let s=this.parameterPositions,o=e-2,c=e+1,h=s[o],d=s[c];if(h===void 0)switch(this.getSettings_().endingStart){case tc:o=e,h=2*t-n;break;case nc:o=s.length-2,h=t+s[o]-s[o+1];break;default:o=e,h=n}if(d===void 0)switch(this.getSettings_().endingEnd){case tc:c=e,d=2*n-t;break;case nc:c=1,d=n+s[1]-s[0];break;default:c=e-1,d=t}let f=(n-t)*.5,p=this.valueSize;this._weightPrev=f/(t-h),this._weightNext=f/(d-n),this._offsetPrev=o*p,this._offsetNext=c*p}interpolate_(e,t,n,s){let o=this.resultBuffer,c=this.sampleValues,h=this.valueSize,d=e*h,f=d-h,p=this._offsetPrev,_=this._offsetNext,g=this._weightPrev,S=this._weightNext,w=(n-t)/(s-t),R=w*w,x=R*w,y=-g*x+2*g*R-g*w,P=(1+g)*x+(-1.5-2*g)*R+(-.5+g)*w+1,U=(-1-S)*x+(1.5+S)*R+.5*w,I=S*x-S*R;for(let O=0;O!==h;++O)o[O]=y*c[p+O]+P*c[f+O]+U*c[d+O]+I*c[_+O];return o}},io=class extends Fi{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e,t,n,s){let o=this.resultBuffer,c=this.sampleValues,h=this.valueSize,d=e*h,f=d-h,p=(n-t)/(s-t),_=1-p;for(let g=0;g!==h;++g)o[g]=c[f+g]*_+c[d+g]*p;return o}},ro=class extends Fi{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e){return this.copySampleValue_(e-1)}},so=class extends Fi{interpolate_(e,t,n,s){let o=this.resultBuffer,c=this.sampleValues,h=this.valueSize,d=e*h,f=d-h,p=this.inTangents,_=this.outTangents;if(!p||!_){let w=(n-t)/(s-t),R=1-w;for(let x=0;x!==h;++x)o[x]=c[f+x]*R+c[d+x]*w;return o}let g=h*2,S=e-1;for(let w=0;w!==h;++w){let R=c[f+w],x=c[d+w],y=S*g+w*2,P=_[y],U=_[y+1],I=e*g+w*2,O=p[I],N=p[I+1],b=Q0(n,t,P,O,s);o[w]=dd(b,R,U,N,x)}return o}};function dd(i,e,t,n,s){let o=1-i;return o*o*o*e+3*o*o*i*t+3*o*i*i*n+i*i*i*s}function K0(i,e,t,n,s){let o=1-i;return 3*o*o*(t-e)+6*o*i*(n-t)+3*i*i*(s-n)}function Q0(i,e,t,n,s){let o=(i-e)/(s-e);for(let c=0;c<8;c++){let h=dd(o,e,t,n,s)-i;if(Math.abs(h)<1e-10)break;let d=K0(o,e,t,n,s);if(Math.abs(d)<1e-10)break;o=Math.max(0,Math.min(1,o-h/d))}return o}var Tn=class{constructor(e,t,n,s){if(e===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(t===void 0||t.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+e);this.name=e,this.times=wr(t,this.TimeBufferType),this.values=wr(n,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(e){let t=e.constructor,n;if(t.toJSON!==this.toJSON)n=t.toJSON(e);else{n={name:e.name,times:wr(e.times,Array),values:wr(e.values,Array)};let s=e.getInterpolation();s!==e.DefaultInterpolation&&(n.interpolation=s),Pa(e.settings)&&(n.settings={inTangents:wr(e.settings.inTangents,Array),outTangents:wr(e.settings.outTangents,Array)})}return n.type=e.ValueTypeName,n}InterpolantFactoryMethodDiscrete(e){return new ro(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodLinear(e){return new io(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodSmooth(e){return new no(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodBezier(e){let t=new so(this.times,this.values,this.getValueSize(),e);return this.settings&&(t.inTangents=this.settings.inTangents,t.outTangents=this.settings.outTangents),t}setInterpolation(e){let t;switch(e){case cs:t=this.InterpolantFactoryMethodDiscrete;break;case Wa:t=this.InterpolantFactoryMethodLinear;break;case Da:t=this.InterpolantFactoryMethodSmooth;break;case Ql:t=this.InterpolantFactoryMethodBezier;break}if(t===void 0){let n="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(e!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(n);return Qe("KeyframeTrack:",n),this}return this.createInterpolant=t,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return cs;case this.InterpolantFactoryMethodLinear:return Wa;case this.InterpolantFactoryMethodSmooth:return Da;case this.InterpolantFactoryMethodBezier:return Ql}}getValueSize(){return this.values.length/this.times.length}shift(e){if(e!==0){let t=this.times;for(let n=0,s=t.length;n!==s;++n)t[n]+=e;Pa(this.settings)&&(_u(this.settings.inTangents,e),_u(this.settings.outTangents,e))}return this}scale(e){if(e!==1){let t=this.times;for(let n=0,s=t.length;n!==s;++n)t[n]*=e;Pa(this.settings)&&(vu(this.settings.inTangents,e),vu(this.settings.outTangents,e))}return this}trim(e,t){let n=this.times,s=n.length,o=0,c=s-1;for(;o!==s&&n[o]<e;)++o;for(;c!==-1&&n[c]>t;)--c;if(++c,o!==0||c!==s){o>=c&&(c=Math.max(c,1),o=c-1);let h=this.getValueSize();this.times=n.slice(o,c),this.values=this.values.slice(o*h,c*h)}return this}validate(){let e=!0,t=this.getValueSize();t-Math.floor(t)!==0&&(tt("KeyframeTrack: Invalid value size in track.",this),e=!1);let n=this.times,s=this.values,o=n.length;o===0&&(tt("KeyframeTrack: Track is empty.",this),e=!1);let c=null;for(let h=0;h!==o;h++){let d=n[h];if(typeof d=="number"&&isNaN(d)){tt("KeyframeTrack: Time is not a valid number.",this,h,d),e=!1;break}if(c!==null&&c>d){tt("KeyframeTrack: Out of order keys.",this,h,d,c),e=!1;break}c=d}if(s!==void 0&&m0(s))for(let h=0,d=s.length;h!==d;++h){let f=s[h];if(isNaN(f)){tt("KeyframeTrack: Value is not a valid number.",this,h,f),e=!1;break}}return e}optimize(){let e=this.times.slice(),t=this.values.slice(),n=this.getValueSize(),s=this.getInterpolation()===Da,o=e.length-1,c=1;for(let h=1;h<o;++h){let d=!1,f=e[h],p=e[h+1];if(f!==p&&(h!==1||f!==e[0]))if(s)d=!0;else{let _=h*n,g=_-n,S=_+n;for(let w=0;w!==n;++w){let R=t[_+w];if(R!==t[g+w]||R!==t[S+w]){d=!0;break}}}if(d){if(h!==c){e[c]=e[h];let _=h*n,g=c*n;for(let S=0;S!==n;++S)t[g+S]=t[_+S]}++c}}if(o>0){e[c]=e[o];for(let h=o*n,d=c*n,f=0;f!==n;++f)t[d+f]=t[h+f];++c}return c!==e.length?(this.times=e.slice(0,c),this.values=t.slice(0,c*n)):(this.times=e,this.values=t),this}clone(){let e=this.times.slice(),t=this.values.slice(),n=this.constructor,s=new n(this.name,e,t);return s.createInterpolant=this.createInterpolant,Pa(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function _u(i,e){for(let t=0,n=i.length;t!==n;t+=2)i[t]+=e}function vu(i,e){for(let t=0,n=i.length;t!==n;t+=2)i[t]*=e}Tn.prototype.ValueTypeName="";Tn.prototype.TimeBufferType=Float32Array;Tn.prototype.ValueBufferType=Float32Array;Tn.prototype.DefaultInterpolation=Wa;var Ni=class extends Tn{constructor(e,t,n){super(e,t,n)}};Ni.prototype.ValueTypeName="bool";Ni.prototype.ValueBufferType=Array;Ni.prototype.DefaultInterpolation=cs;Ni.prototype.InterpolantFactoryMethodLinear=void 0;Ni.prototype.InterpolantFactoryMethodSmooth=void 0;var ao=class extends Tn{constructor(e,t,n,s){super(e,t,n,s)}};ao.prototype.ValueTypeName="color";var oo=class extends Tn{constructor(e,t,n,s){super(e,t,n,s)}};oo.prototype.ValueTypeName="number";var lo=class extends Fi{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e,t,n,s){let o=this.resultBuffer,c=this.sampleValues,h=this.valueSize,d=(n-t)/(s-t),f=e*h;for(let p=f+h;f!==p;f+=4)ni.slerpFlat(o,0,c,f-h,c,f,d);return o}},Es=class extends Tn{constructor(e,t,n,s){super(e,t,n,s)}InterpolantFactoryMethodLinear(e){return new lo(this.times,this.values,this.getValueSize(),e)}};Es.prototype.ValueTypeName="quaternion";Es.prototype.InterpolantFactoryMethodSmooth=void 0;var Ui=class extends Tn{constructor(e,t,n){super(e,t,n)}};Ui.prototype.ValueTypeName="string";Ui.prototype.ValueBufferType=Array;Ui.prototype.DefaultInterpolation=cs;Ui.prototype.InterpolantFactoryMethodLinear=void 0;Ui.prototype.InterpolantFactoryMethodSmooth=void 0;var co=class extends Tn{constructor(e,t,n,s){super(e,t,n,s)}};co.prototype.ValueTypeName="vector";var ho=class{constructor(e,t,n){let s=this,o=!1,c=0,h=0,d,f=[];this.onStart=void 0,this.onLoad=e,this.onProgress=t,this.onError=n,this._abortController=null,this.itemStart=function(p){h++,o===!1&&s.onStart!==void 0&&s.onStart(p,c,h),o=!0},this.itemEnd=function(p){c++,s.onProgress!==void 0&&s.onProgress(p,c,h),c===h&&(o=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(p){s.onError!==void 0&&s.onError(p)},this.resolveURL=function(p){return p=p.normalize("NFC"),d?d(p):p},this.setURLModifier=function(p){return d=p,this},this.addHandler=function(p,_){return f.push(p,_),this},this.removeHandler=function(p){let _=f.indexOf(p);return _!==-1&&f.splice(_,2),this},this.getHandler=function(p){for(let _=0,g=f.length;_<g;_+=2){let S=f[_],w=f[_+1];if(S.global&&(S.lastIndex=0),S.test(p))return w}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},fd=new ho,uo=class{constructor(e){this.manager=e!==void 0?e:fd,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(e,t){let n=this;return new Promise(function(s,o){n.load(e,s,t,o)})}parse(){}setCrossOrigin(e){return this.crossOrigin=e,this}setWithCredentials(e){return this.withCredentials=e,this}setPath(e){return this.path=e,this}setResourcePath(e){return this.resourcePath=e,this}setRequestHeader(e){return this.requestHeader=e,this}setPriority(e){return this.priority=e,this}setCache(e){return this.cache=e,this}abort(){return this}};uo.DEFAULT_MATERIAL_NAME="__DEFAULT";var Ts=class extends ln{static registerNode(e){this.prototype._lightNode=e}constructor(e,t=1){super(),this.isLight=!0,this.type="Light",this.color=new ut(e),this.intensity=t}copy(e,t){return super.copy(e,t),this.color.copy(e.color),this.intensity=e.intensity,this}toJSON(e){let t=super.toJSON(e);return t.object.color=this.color.getHex(),t.object.intensity=this.intensity,t}},As=class extends Ts{constructor(e,t,n){super(e,n),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(ln.DEFAULT_UP),this.updateMatrix(),this.groundColor=new ut(t)}copy(e,t){return super.copy(e,t),this.groundColor.copy(e.groundColor),this}toJSON(e){let t=super.toJSON(e);return t.object.groundColor=this.groundColor.getHex(),t}},Kl=new It,yu=new Q,xu=new Q,fo=class{constructor(e){this.camera=e,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new gt(512,512),this.mapType=Sn,this.map=null,this.mapPass=null,this.matrix=new It,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new Li,this._frameExtents=new gt(1,1),this._viewportCount=1,this._viewports=[new zt(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(e){let t=this.camera;yu.setFromMatrixPosition(e.matrixWorld),t.position.copy(yu),xu.setFromMatrixPosition(e.target.matrixWorld),t.lookAt(xu),t.updateMatrixWorld(),this._updateMatrix(t,this.matrix,this._frustum)}_updateMatrix(e,t,n,s){Kl.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),n.setFromProjectionMatrix(Kl,e.coordinateSystem,e.reversedDepth);let o=this._frameExtents,c=s?s.z/o.x:1,h=s?s.w/o.y:1,d=s?s.x/o.x:0,f=s?s.y/o.y:0;e.coordinateSystem===Rr||e.reversedDepth?t.set(.5*c,0,0,.5*c+d,0,.5*h,0,.5*h+f,0,0,1,0,0,0,0,1):t.set(.5*c,0,0,.5*c+d,0,.5*h,0,.5*h+f,0,0,.5,.5,0,0,0,1),t.multiply(Kl)}getViewport(e){return this._viewports[e]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(e){return this.camera=e.camera.clone(),this.intensity=e.intensity,this.bias=e.bias,this.radius=e.radius,this.autoUpdate=e.autoUpdate,this.needsUpdate=e.needsUpdate,this.normalBias=e.normalBias,this.blurSamples=e.blurSamples,this.mapSize.copy(e.mapSize),this.mapType=e.mapType,this.biasNode=e.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let e={};return e.intensity=this.intensity,e.bias=this.bias,e.normalBias=this.normalBias,e.radius=this.radius,e.blurSamples=this.blurSamples,e.mapSize=this.mapSize.toArray(),e.mapType=this.mapType,e.camera=this.camera.toJSON(!1).object,delete e.camera.matrix,e}},Ia=new Q,La=new ni,Kn=new Q,Cs=class extends ln{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new It,this.projectionMatrix=new It,this.projectionMatrixInverse=new It,this.coordinateSystem=In,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(e,t){return super.copy(e,t),this.matrixWorldInverse.copy(e.matrixWorldInverse),this.projectionMatrix.copy(e.projectionMatrix),this.projectionMatrixInverse.copy(e.projectionMatrixInverse),this.coordinateSystem=e.coordinateSystem,this}getWorldDirection(e){return super.getWorldDirection(e).negate()}updateMatrixWorld(e){super.updateMatrixWorld(e),this.matrixWorld.decompose(Ia,La,Kn),Kn.x===1&&Kn.y===1&&Kn.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Ia,La,Kn.set(1,1,1)).invert()}updateWorldMatrix(e,t,n=!1){super.updateWorldMatrix(e,t,n),this.matrixWorld.decompose(Ia,La,Kn),Kn.x===1&&Kn.y===1&&Kn.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Ia,La,Kn.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},Ri=new Q,Su=new gt,Mu=new gt,gn=class extends Cs{constructor(e=50,t=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=e,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=t,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.fov=e.fov,this.zoom=e.zoom,this.near=e.near,this.far=e.far,this.focus=e.focus,this.aspect=e.aspect,this.view=e.view===null?null:Object.assign({},e.view),this.filmGauge=e.filmGauge,this.filmOffset=e.filmOffset,this}setFocalLength(e){let t=.5*this.getFilmHeight()/e;this.fov=Ir*2*Math.atan(t),this.updateProjectionMatrix()}getFocalLength(){let e=Math.tan(os*.5*this.fov);return .5*this.getFilmHeight()/e}getEffectiveFOV(){return Ir*2*Math.atan(Math.tan(os*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(e,t,n){Ri.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),t.set(Ri.x,Ri.y).multiplyScalar(-e/Ri.z),Ri.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(Ri.x,Ri.y).multiplyScalar(-e/Ri.z)}getViewSize(e,t){return this.getViewBounds(e,Su,Mu),t.subVectors(Mu,Su)}setViewOffset(e,t,n,s,o,c){this.aspect=e/t,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=s,this.view.width=o,this.view.height=c,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=this.near,t=e*Math.tan(os*.5*this.fov)/this.zoom,n=2*t,s=this.aspect*n,o=-.5*s,c=this.view;if(this.view!==null&&this.view.enabled){let d=c.fullWidth,f=c.fullHeight;o+=c.offsetX*s/d,t-=c.offsetY*n/f,s*=c.width/d,n*=c.height/f}let h=this.filmOffset;h!==0&&(o+=e*h/this.getFilmWidth()),this.projectionMatrix.makePerspective(o,o+s,t,t-n,e,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.fov=this.fov,t.object.zoom=this.zoom,t.object.near=this.near,t.object.far=this.far,t.object.focus=this.focus,t.object.aspect=this.aspect,this.view!==null&&(t.object.view=Object.assign({},this.view)),t.object.filmGauge=this.filmGauge,t.object.filmOffset=this.filmOffset,t}};var Rs=class extends Cs{constructor(e=-1,t=1,n=1,s=-1,o=.1,c=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=e,this.right=t,this.top=n,this.bottom=s,this.near=o,this.far=c,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.left=e.left,this.right=e.right,this.top=e.top,this.bottom=e.bottom,this.near=e.near,this.far=e.far,this.zoom=e.zoom,this.view=e.view===null?null:Object.assign({},e.view),this}setViewOffset(e,t,n,s,o,c){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=s,this.view.width=o,this.view.height=c,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=(this.right-this.left)/(2*this.zoom),t=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2,o=n-e,c=n+e,h=s+t,d=s-t;if(this.view!==null&&this.view.enabled){let f=(this.right-this.left)/this.view.fullWidth/this.zoom,p=(this.top-this.bottom)/this.view.fullHeight/this.zoom;o+=f*this.view.offsetX,c=o+f*this.view.width,h-=p*this.view.offsetY,d=h-p*this.view.height}this.projectionMatrix.makeOrthographic(o,c,h,d,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.zoom=this.zoom,t.object.left=this.left,t.object.right=this.right,t.object.top=this.top,t.object.bottom=this.bottom,t.object.near=this.near,t.object.far=this.far,this.view!==null&&(t.object.view=Object.assign({},this.view)),t}},ic=class extends fo{constructor(){super(new Rs(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},Ps=class extends Ts{constructor(e,t){super(e,t),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(ln.DEFAULT_UP),this.updateMatrix(),this.target=new ln,this.shadow=new ic}dispose(){super.dispose(),this.shadow.dispose()}copy(e){return super.copy(e),this.target=e.target.clone(),this.shadow=e.shadow.clone(),this}toJSON(e){let t=super.toJSON(e);return t.object.shadow=this.shadow.toJSON(),t.object.target=this.target.uuid,t}};var Er=-90,Tr=1,Br=class extends ln{constructor(e,t,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new gn(Er,Tr,e,t);s.layers=this.layers,this.add(s);let o=new gn(Er,Tr,e,t);o.layers=this.layers,this.add(o);let c=new gn(Er,Tr,e,t);c.layers=this.layers,this.add(c);let h=new gn(Er,Tr,e,t);h.layers=this.layers,this.add(h);let d=new gn(Er,Tr,e,t);d.layers=this.layers,this.add(d);let f=new gn(Er,Tr,e,t);f.layers=this.layers,this.add(f)}updateCoordinateSystem(){let e=this.coordinateSystem,t=this.children.concat(),[n,s,o,c,h,d]=t;for(let f of t)this.remove(f);if(e===In)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),o.up.set(0,0,-1),o.lookAt(0,1,0),c.up.set(0,0,1),c.lookAt(0,-1,0),h.up.set(0,1,0),h.lookAt(0,0,1),d.up.set(0,1,0),d.lookAt(0,0,-1);else if(e===Rr)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),o.up.set(0,0,1),o.lookAt(0,1,0),c.up.set(0,0,-1),c.lookAt(0,-1,0),h.up.set(0,-1,0),h.lookAt(0,0,1),d.up.set(0,-1,0),d.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+e);for(let f of t)this.add(f),f.updateMatrixWorld()}update(e,t){this.parent===null&&this.updateMatrixWorld();let{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==e.coordinateSystem&&(this.coordinateSystem=e.coordinateSystem,this.updateCoordinateSystem());let[o,c,h,d,f,p]=this.children,_=e.getRenderTarget(),g=e.getActiveCubeFace(),S=e.getActiveMipmapLevel(),w=e.xr.enabled;e.xr.enabled=!1;let R=n.texture.mipmapsAutoUpdate;n.texture.mipmapsAutoUpdate=!1;let x=!1;e.isWebGLRenderer===!0?x=e.state.buffers.depth.getReversed():x=e.reversedDepthBuffer,e.setRenderTarget(n,0,s),x&&e.autoClear===!1&&e.clearDepth(),e.render(t,o),e.setRenderTarget(n,1,s),x&&e.autoClear===!1&&e.clearDepth(),e.render(t,c),e.setRenderTarget(n,2,s),x&&e.autoClear===!1&&e.clearDepth(),e.render(t,h),e.setRenderTarget(n,3,s),x&&e.autoClear===!1&&e.clearDepth(),e.render(t,d),e.setRenderTarget(n,4,s),x&&e.autoClear===!1&&e.clearDepth(),e.render(t,f),n.texture.mipmapsAutoUpdate=R,e.setRenderTarget(n,5,s),x&&e.autoClear===!1&&e.clearDepth(),e.render(t,p),e.setRenderTarget(_,g,S),e.xr.enabled=w,n.texture.needsPMREMUpdate=!0}},po=class extends gn{constructor(e=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=e,this.perCameraFrustumCulled=!1}};var Bc="\\[\\]\\.:\\/",ev=new RegExp("["+Bc+"]","g"),kc="[^"+Bc+"]",tv="[^"+Bc.replace("\\.","")+"]",nv=/((?:WC+[\/:])*)/.source.replace("WC",kc),iv=/(WCOD+)?/.source.replace("WCOD",tv),rv=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",kc),sv=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",kc),av=new RegExp("^"+nv+iv+rv+sv+"$"),ov=["material","materials","bones","map"],rc=class{constructor(e,t,n){let s=n||kt.parseTrackName(t);this._targetGroup=e,this._bindings=e.subscribe_(t,s)}getValue(e,t){this.bind();let n=this._targetGroup.nCachedObjects_,s=this._bindings[n];s!==void 0&&s.getValue(e,t)}setValue(e,t){let n=this._bindings;for(let s=this._targetGroup.nCachedObjects_,o=n.length;s!==o;++s)n[s].setValue(e,t)}bind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].bind()}unbind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].unbind()}},kt=class i{constructor(e,t,n){this.path=t,this.parsedPath=n||i.parseTrackName(t),this.node=i.findNode(e,this.parsedPath.nodeName),this.rootNode=e,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(e,t,n){return e&&e.isAnimationObjectGroup?new i.Composite(e,t,n):new i(e,t,n)}static sanitizeNodeName(e){return e.replace(/\s/g,"_").replace(ev,"")}static parseTrackName(e){let t=av.exec(e);if(t===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+e);let n={nodeName:t[2],objectName:t[3],objectIndex:t[4],propertyName:t[5],propertyIndex:t[6]},s=n.nodeName&&n.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let o=n.nodeName.substring(s+1);ov.indexOf(o)!==-1&&(n.nodeName=n.nodeName.substring(0,s),n.objectName=o)}if(n.propertyName===null||n.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+e);return n}static findNode(e,t){if(t===void 0||t===""||t==="."||t===-1||t===e.name||t===e.uuid)return e;if(e.skeleton){let n=e.skeleton.getBoneByName(t);if(n!==void 0)return n}if(e.children){let n=function(o){for(let c=0;c<o.length;c++){let h=o[c];if(h.name===t||h.uuid===t)return h;let d=n(h.children);if(d)return d}return null},s=n(e.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(e,t){e[t]=this.targetObject[this.propertyName]}_getValue_array(e,t){let n=this.resolvedProperty;for(let s=0,o=n.length;s!==o;++s)e[t++]=n[s]}_getValue_arrayElement(e,t){e[t]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(e,t){this.resolvedProperty.toArray(e,t)}_setValue_direct(e,t){this.targetObject[this.propertyName]=e[t]}_setValue_direct_setNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(e,t){let n=this.resolvedProperty;for(let s=0,o=n.length;s!==o;++s)n[s]=e[t++]}_setValue_array_setNeedsUpdate(e,t){let n=this.resolvedProperty;for(let s=0,o=n.length;s!==o;++s)n[s]=e[t++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(e,t){let n=this.resolvedProperty;for(let s=0,o=n.length;s!==o;++s)n[s]=e[t++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(e,t){this.resolvedProperty[this.propertyIndex]=e[t]}_setValue_arrayElement_setNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(e,t){this.resolvedProperty.fromArray(e,t)}_setValue_fromArray_setNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(e,t){this.bind(),this.getValue(e,t)}_setValue_unbound(e,t){this.bind(),this.setValue(e,t)}bind(){let e=this.node,t=this.parsedPath,n=t.objectName,s=t.propertyName,o=t.propertyIndex;if(e||(e=i.findNode(this.rootNode,t.nodeName),this.node=e),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!e){Qe("PropertyBinding: No target node found for track: "+this.path+".");return}if(n){let f=t.objectIndex;switch(n){case"materials":if(!e.material){tt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.materials){tt("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}e=e.material.materials;break;case"bones":if(!e.skeleton){tt("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}e=e.skeleton.bones;for(let p=0;p<e.length;p++)if(e[p].name===f){f=p;break}break;case"map":if("map"in e){e=e.map;break}if(!e.material){tt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.map){tt("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}e=e.material.map;break;default:if(e[n]===void 0){tt("PropertyBinding: Can not bind to objectName of node undefined.",this);return}e=e[n]}if(f!==void 0){if(e[f]===void 0){tt("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,e);return}e=e[f]}}let c=e[s];if(c===void 0){let f=t.nodeName;tt("PropertyBinding: Trying to update property for track: "+f+"."+s+" but it wasn't found.",e);return}let h=this.Versioning.None;this.targetObject=e,e.isMaterial===!0?h=this.Versioning.NeedsUpdate:e.isObject3D===!0&&(h=this.Versioning.MatrixWorldNeedsUpdate);let d=this.BindingType.Direct;if(o!==void 0){if(s==="morphTargetInfluences"){if(!e.geometry){tt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!e.geometry.morphAttributes){tt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}e.morphTargetDictionary[o]!==void 0&&(o=e.morphTargetDictionary[o])}d=this.BindingType.ArrayElement,this.resolvedProperty=c,this.propertyIndex=o}else c.fromArray!==void 0&&c.toArray!==void 0?(d=this.BindingType.HasFromToArray,this.resolvedProperty=c):Array.isArray(c)?(d=this.BindingType.EntireArray,this.resolvedProperty=c):this.propertyName=s;this.getValue=this.GetterByBindingType[d],this.setValue=this.SetterByBindingTypeAndVersioning[d][h]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};kt.Composite=rc;kt.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};kt.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};kt.prototype.GetterByBindingType=[kt.prototype._getValue_direct,kt.prototype._getValue_array,kt.prototype._getValue_arrayElement,kt.prototype._getValue_toArray];kt.prototype.SetterByBindingTypeAndVersioning=[[kt.prototype._setValue_direct,kt.prototype._setValue_direct_setNeedsUpdate,kt.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[kt.prototype._setValue_array,kt.prototype._setValue_array_setNeedsUpdate,kt.prototype._setValue_array_setMatrixWorldNeedsUpdate],[kt.prototype._setValue_arrayElement,kt.prototype._setValue_arrayElement_setNeedsUpdate,kt.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[kt.prototype._setValue_fromArray,kt.prototype._setValue_fromArray_setNeedsUpdate,kt.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var wb=new Float32Array(1);var bu=new It,kr=class{constructor(e,t,n=0,s=1/0){this.ray=new Nr(e,t),this.near=n,this.far=s,this.camera=null,this.layers=new Dr,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(e,t){this.ray.set(e,t)}setFromCamera(e,t){t.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(e.x,e.y,.5).unproject(t).sub(this.ray.origin).normalize(),this.camera=t):t.isOrthographicCamera?(this.ray.origin.set(e.x,e.y,t.projectionMatrix.elements[14]).unproject(t),this.ray.direction.set(0,0,-1).transformDirection(t.matrixWorld),this.camera=t):tt("Raycaster: Unsupported camera type: "+t.type)}setFromXRController(e){return bu.identity().extractRotation(e.matrixWorld),this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(bu),this}intersectObject(e,t=!0,n=[]){return sc(e,this,n,t),n.sort(wu),n}intersectObjects(e,t=!0,n=[]){for(let s=0,o=e.length;s<o;s++)sc(e[s],this,n,t);return n.sort(wu),n}};function wu(i,e){return i.distance-e.distance}function sc(i,e,t,n){let s=!0;if(i.layers.test(e.layers)&&i.raycast(e,t)===!1&&(s=!1),s===!0&&n===!0){let o=i.children;for(let c=0,h=o.length;c<h;c++)sc(o[c],e,t,!0)}}var ac=class{static{this.prototype.isMatrix2=!0}constructor(e,t,n,s){this.elements=[1,0,0,1],e!==void 0&&this.set(e,t,n,s)}identity(){return this.set(1,0,0,1),this}fromArray(e,t=0){for(let n=0;n<4;n++)this.elements[n]=e[n+t];return this}set(e,t,n,s){let o=this.elements;return o[0]=e,o[2]=t,o[1]=n,o[3]=s,this}};function zc(i,e,t,n){let s=lv(n);switch(t){case Tc:return i*e;case Cc:return i*e/s.components*s.byteLength;case So:return i*e/s.components*s.byteLength;case Bi:return i*e*2/s.components*s.byteLength;case Mo:return i*e*2/s.components*s.byteLength;case Ac:return i*e*3/s.components*s.byteLength;case Hn:return i*e*4/s.components*s.byteLength;case bo:return i*e*4/s.components*s.byteLength;case Ls:case Ds:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*8;case Fs:case Ns:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case Eo:case Ao:return Math.max(i,16)*Math.max(e,8)/4;case wo:case To:return Math.max(i,8)*Math.max(e,8)/2;case Co:case Ro:case Io:case Lo:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*8;case Po:case Us:case Do:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case Fo:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case No:return Math.floor((i+4)/5)*Math.floor((e+3)/4)*16;case Uo:return Math.floor((i+4)/5)*Math.floor((e+4)/5)*16;case Oo:return Math.floor((i+5)/6)*Math.floor((e+4)/5)*16;case Bo:return Math.floor((i+5)/6)*Math.floor((e+5)/6)*16;case ko:return Math.floor((i+7)/8)*Math.floor((e+4)/5)*16;case zo:return Math.floor((i+7)/8)*Math.floor((e+5)/6)*16;case Go:return Math.floor((i+7)/8)*Math.floor((e+7)/8)*16;case Vo:return Math.floor((i+9)/10)*Math.floor((e+4)/5)*16;case Ho:return Math.floor((i+9)/10)*Math.floor((e+5)/6)*16;case Wo:return Math.floor((i+9)/10)*Math.floor((e+7)/8)*16;case Xo:return Math.floor((i+9)/10)*Math.floor((e+9)/10)*16;case $o:return Math.floor((i+11)/12)*Math.floor((e+9)/10)*16;case qo:return Math.floor((i+11)/12)*Math.floor((e+11)/12)*16;case Yo:case jo:case Jo:return Math.ceil(i/4)*Math.ceil(e/4)*16;case Zo:case Ko:return Math.ceil(i/4)*Math.ceil(e/4)*8;case Os:case Qo:return Math.ceil(i/4)*Math.ceil(e/4)*16}throw new Error(`Unable to determine texture byte length for ${t} format.`)}function lv(i){switch(i){case Sn:case Mc:return{byteLength:1,components:1};case Hr:case bc:case Vn:return{byteLength:2,components:1};case yo:case xo:return{byteLength:2,components:4};case zn:case vo:case Gn:return{byteLength:4,components:1};case wc:case Ec:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${i}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Qe("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function Nd(){let i=null,e=!1,t=null,n=null;function s(o,c){n=i.requestAnimationFrame(s),t(o,c)}return{start:function(){e!==!0&&t!==null&&i!==null&&(n=i.requestAnimationFrame(s),e=!0)},stop:function(){i!==null&&i.cancelAnimationFrame(n),e=!1},setAnimationLoop:function(o){t=o},setContext:function(o){i=o}}}function hv(i){let e=new WeakMap;function t(h,d){let f=h.array,p=h.usage,_=f.byteLength,g=i.createBuffer();i.bindBuffer(d,g),i.bufferData(d,f,p),h.onUploadCallback();let S;if(f instanceof Float32Array)S=i.FLOAT;else if(typeof Float16Array<"u"&&f instanceof Float16Array)S=i.HALF_FLOAT;else if(f instanceof Uint16Array)h.isFloat16BufferAttribute?S=i.HALF_FLOAT:S=i.UNSIGNED_SHORT;else if(f instanceof Int16Array)S=i.SHORT;else if(f instanceof Uint32Array)S=i.UNSIGNED_INT;else if(f instanceof Int32Array)S=i.INT;else if(f instanceof Int8Array)S=i.BYTE;else if(f instanceof Uint8Array)S=i.UNSIGNED_BYTE;else if(f instanceof Uint8ClampedArray)S=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+f);return{buffer:g,type:S,bytesPerElement:f.BYTES_PER_ELEMENT,version:h.version,size:_}}function n(h,d,f){let p=d.array,_=d.updateRanges;if(i.bindBuffer(f,h),_.length===0)i.bufferSubData(f,0,p);else{_.sort((S,w)=>S.start-w.start);let g=0;for(let S=1;S<_.length;S++){let w=_[g],R=_[S];R.start<=w.start+w.count+1?w.count=Math.max(w.count,R.start+R.count-w.start):(++g,_[g]=R)}_.length=g+1;for(let S=0,w=_.length;S<w;S++){let R=_[S];i.bufferSubData(f,R.start*p.BYTES_PER_ELEMENT,p,R.start,R.count)}d.clearUpdateRanges()}d.onUploadCallback()}function s(h){return h.isInterleavedBufferAttribute&&(h=h.data),e.get(h)}function o(h){h.isInterleavedBufferAttribute&&(h=h.data);let d=e.get(h);d&&(i.deleteBuffer(d.buffer),e.delete(h))}function c(h,d){if(h.isInterleavedBufferAttribute&&(h=h.data),h.isGLBufferAttribute){let p=e.get(h);(!p||p.version<h.version)&&e.set(h,{buffer:h.buffer,type:h.type,bytesPerElement:h.elementSize,version:h.version});return}let f=e.get(h);if(f===void 0)e.set(h,t(h,d));else if(f.version<h.version){if(f.size!==h.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(f.buffer,h,d),f.version=h.version}}return{get:s,remove:o,update:c}}var uv=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,dv=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,fv=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,pv=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,mv=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,gv=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,_v=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,vv=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,yv=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,xv=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,Sv=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,Mv=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,bv=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,wv=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,Ev=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,Tv=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,Av=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,Cv=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,Rv=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,Pv=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,Iv=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,Lv=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,Dv=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,Fv=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,Nv=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,Uv=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,Ov=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,Bv=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,kv=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,zv="gl_FragColor = linearToOutputTexel( gl_FragColor );",Gv=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,Vv=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,Hv=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,Wv=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,Xv=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,$v=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,qv=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,Yv=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,jv=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,Jv=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,Zv=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,Kv=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,Qv=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,ey=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,ty=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,ny=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,iy=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,ry=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,sy=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,ay=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,oy=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,ly=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,cy=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,hy=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,uy=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,dy=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,fy=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,py=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,my=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,gy=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,_y=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,vy=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,yy=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,xy=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,Sy=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,My=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,by=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,wy=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,Ey=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,Ty=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,Ay=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,Cy=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,Ry=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,Py=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Iy=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,Ly=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,Dy=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,Fy=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,Ny=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,Uy=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,Oy=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,By=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,ky=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,zy=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,Gy=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,Vy=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,Hy=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,Wy=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,Xy=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,$y=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,qy=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,Yy=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,jy=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,Jy=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,Zy=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,Ky=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,Qy=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,ex=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,tx=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,nx=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,ix=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,rx=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,sx=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,ax=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,ox=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,lx=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,cx=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,hx=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,ux=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,dx=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,fx=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,px=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,mx=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,gx=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,_x=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,vx=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,yx=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,xx=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,Sx=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Mx=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,bx=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,wx=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,Ex=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Tx=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Ax=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Cx=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,Rx=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Px=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,Ix=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,Lx=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Dx=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Fx=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,Nx=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Ux=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Ox=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Bx=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,kx=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,zx=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Gx=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Vx=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,Hx=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,mt={alphahash_fragment:uv,alphahash_pars_fragment:dv,alphamap_fragment:fv,alphamap_pars_fragment:pv,alphatest_fragment:mv,alphatest_pars_fragment:gv,aomap_fragment:_v,aomap_pars_fragment:vv,batching_pars_vertex:yv,batching_vertex:xv,begin_vertex:Sv,beginnormal_vertex:Mv,bsdfs:bv,iridescence_fragment:wv,bumpmap_pars_fragment:Ev,clipping_planes_fragment:Tv,clipping_planes_pars_fragment:Av,clipping_planes_pars_vertex:Cv,clipping_planes_vertex:Rv,color_fragment:Pv,color_pars_fragment:Iv,color_pars_vertex:Lv,color_vertex:Dv,common:Fv,defaultnormal_vertex:Nv,displacementmap_pars_vertex:Uv,displacementmap_vertex:Ov,emissivemap_fragment:Bv,emissivemap_pars_fragment:kv,colorspace_fragment:zv,colorspace_pars_fragment:Gv,envmap_fragment:Vv,envmap_common_pars_fragment:Hv,envmap_pars_fragment:Wv,envmap_pars_vertex:Xv,envmap_physical_pars_fragment:ny,envmap_vertex:$v,fog_vertex:qv,fog_pars_vertex:Yv,fog_fragment:jv,fog_pars_fragment:Jv,gradientmap_pars_fragment:Zv,lightmap_pars_fragment:Kv,lights_lambert_fragment:Qv,lights_lambert_pars_fragment:ey,lights_pars_begin:ty,lights_toon_fragment:iy,lights_toon_pars_fragment:ry,lights_phong_fragment:sy,lights_phong_pars_fragment:ay,lights_physical_fragment:oy,lights_physical_pars_fragment:ly,lights_fragment_begin:cy,lights_fragment_maps:hy,lights_fragment_end:uy,lightprobes_pars_fragment:dy,logdepthbuf_fragment:fy,logdepthbuf_pars_fragment:py,logdepthbuf_pars_vertex:my,logdepthbuf_vertex:gy,map_fragment:_y,map_pars_fragment:vy,map_particle_fragment:yy,map_particle_pars_fragment:xy,metalnessmap_fragment:Sy,metalnessmap_pars_fragment:My,morphinstance_vertex:by,morphcolor_vertex:wy,morphnormal_vertex:Ey,morphtarget_pars_vertex:Ty,morphtarget_vertex:Ay,normal_fragment_begin:Cy,normal_fragment_maps:Ry,normal_pars_fragment:Py,normal_pars_vertex:Iy,normal_vertex:Ly,normalmap_pars_fragment:Dy,clearcoat_normal_fragment_begin:Fy,clearcoat_normal_fragment_maps:Ny,clearcoat_pars_fragment:Uy,iridescence_pars_fragment:Oy,opaque_fragment:By,packing:ky,premultiplied_alpha_fragment:zy,project_vertex:Gy,dithering_fragment:Vy,dithering_pars_fragment:Hy,roughnessmap_fragment:Wy,roughnessmap_pars_fragment:Xy,shadowmap_pars_fragment:$y,shadowmap_pars_vertex:qy,shadowmap_vertex:Yy,shadowmask_pars_fragment:jy,skinbase_vertex:Jy,skinning_pars_vertex:Zy,skinning_vertex:Ky,skinnormal_vertex:Qy,specularmap_fragment:ex,specularmap_pars_fragment:tx,tonemapping_fragment:nx,tonemapping_pars_fragment:ix,transmission_fragment:rx,transmission_pars_fragment:sx,uv_pars_fragment:ax,uv_pars_vertex:ox,uv_vertex:lx,worldpos_vertex:cx,background_vert:hx,background_frag:ux,backgroundCube_vert:dx,backgroundCube_frag:fx,cube_vert:px,cube_frag:mx,depth_vert:gx,depth_frag:_x,distance_vert:vx,distance_frag:yx,equirect_vert:xx,equirect_frag:Sx,linedashed_vert:Mx,linedashed_frag:bx,meshbasic_vert:wx,meshbasic_frag:Ex,meshlambert_vert:Tx,meshlambert_frag:Ax,meshmatcap_vert:Cx,meshmatcap_frag:Rx,meshnormal_vert:Px,meshnormal_frag:Ix,meshphong_vert:Lx,meshphong_frag:Dx,meshphysical_vert:Fx,meshphysical_frag:Nx,meshtoon_vert:Ux,meshtoon_frag:Ox,points_vert:Bx,points_frag:kx,shadow_vert:zx,shadow_frag:Gx,sprite_vert:Vx,sprite_frag:Hx},Be={common:{diffuse:{value:new ut(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new at},alphaMap:{value:null},alphaMapTransform:{value:new at},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new at}},envmap:{envMap:{value:null},envMapRotation:{value:new at},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new at}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new at}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new at},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new at},normalScale:{value:new gt(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new at},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new at}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new at}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new at}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new ut(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new ut(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new at},alphaTest:{value:0},uvTransform:{value:new at}},sprite:{diffuse:{value:new ut(16777215)},opacity:{value:1},center:{value:new gt(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new at},alphaMap:{value:null},alphaMapTransform:{value:new at},alphaTest:{value:0}}},oi={basic:{uniforms:dn([Be.common,Be.specularmap,Be.envmap,Be.aomap,Be.lightmap,Be.fog]),vertexShader:mt.meshbasic_vert,fragmentShader:mt.meshbasic_frag},lambert:{uniforms:dn([Be.common,Be.specularmap,Be.envmap,Be.aomap,Be.lightmap,Be.emissivemap,Be.bumpmap,Be.normalmap,Be.displacementmap,Be.fog,Be.lights,{emissive:{value:new ut(0)},envMapIntensity:{value:1}}]),vertexShader:mt.meshlambert_vert,fragmentShader:mt.meshlambert_frag},phong:{uniforms:dn([Be.common,Be.specularmap,Be.envmap,Be.aomap,Be.lightmap,Be.emissivemap,Be.bumpmap,Be.normalmap,Be.displacementmap,Be.fog,Be.lights,{emissive:{value:new ut(0)},specular:{value:new ut(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:mt.meshphong_vert,fragmentShader:mt.meshphong_frag},standard:{uniforms:dn([Be.common,Be.envmap,Be.aomap,Be.lightmap,Be.emissivemap,Be.bumpmap,Be.normalmap,Be.displacementmap,Be.roughnessmap,Be.metalnessmap,Be.fog,Be.lights,{emissive:{value:new ut(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:mt.meshphysical_vert,fragmentShader:mt.meshphysical_frag},toon:{uniforms:dn([Be.common,Be.aomap,Be.lightmap,Be.emissivemap,Be.bumpmap,Be.normalmap,Be.displacementmap,Be.gradientmap,Be.fog,Be.lights,{emissive:{value:new ut(0)}}]),vertexShader:mt.meshtoon_vert,fragmentShader:mt.meshtoon_frag},matcap:{uniforms:dn([Be.common,Be.bumpmap,Be.normalmap,Be.displacementmap,Be.fog,{matcap:{value:null}}]),vertexShader:mt.meshmatcap_vert,fragmentShader:mt.meshmatcap_frag},points:{uniforms:dn([Be.points,Be.fog]),vertexShader:mt.points_vert,fragmentShader:mt.points_frag},dashed:{uniforms:dn([Be.common,Be.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:mt.linedashed_vert,fragmentShader:mt.linedashed_frag},depth:{uniforms:dn([Be.common,Be.displacementmap]),vertexShader:mt.depth_vert,fragmentShader:mt.depth_frag},normal:{uniforms:dn([Be.common,Be.bumpmap,Be.normalmap,Be.displacementmap,{opacity:{value:1}}]),vertexShader:mt.meshnormal_vert,fragmentShader:mt.meshnormal_frag},sprite:{uniforms:dn([Be.sprite,Be.fog]),vertexShader:mt.sprite_vert,fragmentShader:mt.sprite_frag},background:{uniforms:{uvTransform:{value:new at},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:mt.background_vert,fragmentShader:mt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new at}},vertexShader:mt.backgroundCube_vert,fragmentShader:mt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:mt.cube_vert,fragmentShader:mt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:mt.equirect_vert,fragmentShader:mt.equirect_frag},distance:{uniforms:dn([Be.common,Be.displacementmap,{referencePosition:{value:new Q},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:mt.distance_vert,fragmentShader:mt.distance_frag},shadow:{uniforms:dn([Be.lights,Be.fog,{color:{value:new ut(0)},opacity:{value:1}}]),vertexShader:mt.shadow_vert,fragmentShader:mt.shadow_frag}};oi.physical={uniforms:dn([oi.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new at},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new at},clearcoatNormalScale:{value:new gt(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new at},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new at},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new at},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new at},sheen:{value:0},sheenColor:{value:new ut(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new at},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new at},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new at},transmissionSamplerSize:{value:new gt},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new at},attenuationDistance:{value:0},attenuationColor:{value:new ut(0)},specularColor:{value:new ut(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new at},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new at},anisotropyVector:{value:new gt},anisotropyMap:{value:null},anisotropyMapTransform:{value:new at}}]),vertexShader:mt.meshphysical_vert,fragmentShader:mt.meshphysical_frag};var nl={r:0,b:0,g:0},Wx=new It,Ud=new at;Ud.set(-1,0,0,0,1,0,0,0,1);function Xx(i,e,t,n,s,o){let c=new ut(0),h=s===!0?0:1,d,f,p=null,_=0,g=null;function S(P){let U=P.isScene===!0?P.background:null;if(U&&U.isTexture){let I=P.backgroundBlurriness>0;U=e.get(U,I)}return U}function w(P){let U=!1,I=S(P);I===null?x(c,h):I&&I.isColor&&(x(I,1),U=!0);let O=i.xr.getEnvironmentBlendMode();O==="additive"?t.buffers.color.setClear(0,0,0,1,o):O==="alpha-blend"&&t.buffers.color.setClear(0,0,0,0,o),(i.autoClear||U)&&(t.buffers.depth.setTest(!0),t.buffers.depth.setMask(!0),t.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function R(P,U){let I=S(U);I&&I.isCubeTexture?(f===void 0&&(f=new Ln(new Di(1,1,1),new ii({name:"BackgroundCubeMaterial",uniforms:or(oi.backgroundCube.uniforms),vertexShader:oi.backgroundCube.vertexShader,fragmentShader:oi.backgroundCube.fragmentShader,side:yn,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),f.geometry.deleteAttribute("normal"),f.geometry.deleteAttribute("uv"),f.onBeforeRender=function(O,N,b){this.matrixWorld.copyPosition(b.matrixWorld)},Object.defineProperty(f.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),n.update(f)),f.material.uniforms.envMap.value=I,f.material.uniforms.backgroundBlurriness.value=U.backgroundBlurriness,f.material.uniforms.backgroundIntensity.value=U.backgroundIntensity,f.material.uniforms.backgroundRotation.value.setFromMatrix4(Wx.makeRotationFromEuler(U.backgroundRotation)).transpose(),I.isRenderTargetTexture===!1&&f.material.uniforms.backgroundRotation.value.premultiply(Ud),f.material.toneMapped=yt.getTransfer(I.colorSpace)!==Ct,(p!==I||_!==I.version||g!==i.toneMapping)&&(f.material.needsUpdate=!0,p=I,_=I.version,g=i.toneMapping),f.layers.enableAll(),P.unshift(f,f.geometry,f.material,0,0,null)):I&&I.isTexture&&(d===void 0&&(d=new Ln(new bs(2,2),new ii({name:"BackgroundMaterial",uniforms:or(oi.background.uniforms),vertexShader:oi.background.vertexShader,fragmentShader:oi.background.fragmentShader,side:Oi,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),d.geometry.deleteAttribute("normal"),Object.defineProperty(d.material,"map",{get:function(){return this.uniforms.t2D.value}}),n.update(d)),d.material.uniforms.t2D.value=I,d.material.uniforms.backgroundIntensity.value=U.backgroundIntensity,d.material.toneMapped=yt.getTransfer(I.colorSpace)!==Ct,I.matrixAutoUpdate===!0&&I.updateMatrix(),d.material.uniforms.uvTransform.value.copy(I.matrix),(p!==I||_!==I.version||g!==i.toneMapping)&&(d.material.needsUpdate=!0,p=I,_=I.version,g=i.toneMapping),d.layers.enableAll(),P.unshift(d,d.geometry,d.material,0,0,null))}function x(P,U){P.getRGB(nl,Oc(i)),t.buffers.color.setClear(nl.r,nl.g,nl.b,U,o)}function y(){f!==void 0&&(f.geometry.dispose(),f.material.dispose(),f=void 0),d!==void 0&&(d.geometry.dispose(),d.material.dispose(),d=void 0)}return{getClearColor:function(){return c},setClearColor:function(P,U=1){c.set(P),h=U,x(c,h)},getClearAlpha:function(){return h},setClearAlpha:function(P){h=P,x(c,h)},render:w,addToRenderList:R,dispose:y}}function $x(i,e){let t=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=g(null),o=s,c=!1;function h(Y,J,ee,z,ie){let G=!1,ne=_(Y,z,ee,J);o!==ne&&(o=ne,f(o.object)),G=S(Y,z,ee,ie),G&&w(Y,z,ee,ie),ie!==null&&e.update(ie,i.ELEMENT_ARRAY_BUFFER),(G||c)&&(c=!1,I(Y,J,ee,z),ie!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,e.get(ie).buffer))}function d(){return i.createVertexArray()}function f(Y){return i.bindVertexArray(Y)}function p(Y){return i.deleteVertexArray(Y)}function _(Y,J,ee,z){let ie=z.wireframe===!0,G=n[J.id];G===void 0&&(G={},n[J.id]=G);let ne=Y.isInstancedMesh===!0?Y.id:0,Se=G[ne];Se===void 0&&(Se={},G[ne]=Se);let re=Se[ee.id];re===void 0&&(re={},Se[ee.id]=re);let H=re[ie];return H===void 0&&(H=g(d()),re[ie]=H),H}function g(Y){let J=[],ee=[],z=[];for(let ie=0;ie<t;ie++)J[ie]=0,ee[ie]=0,z[ie]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:J,enabledAttributes:ee,attributeDivisors:z,object:Y,attributes:{},index:null}}function S(Y,J,ee,z){let ie=o.attributes,G=J.attributes,ne=0,Se=ee.getAttributes();for(let re in Se)if(Se[re].location>=0){let me=ie[re],Xe=G[re];if(Xe===void 0&&(re==="instanceMatrix"&&Y.instanceMatrix&&(Xe=Y.instanceMatrix),re==="instanceColor"&&Y.instanceColor&&(Xe=Y.instanceColor)),me===void 0||me.attribute!==Xe||Xe&&me.data!==Xe.data)return!0;ne++}return o.attributesNum!==ne||o.index!==z}function w(Y,J,ee,z){let ie={},G=J.attributes,ne=0,Se=ee.getAttributes();for(let re in Se)if(Se[re].location>=0){let me=G[re];me===void 0&&(re==="instanceMatrix"&&Y.instanceMatrix&&(me=Y.instanceMatrix),re==="instanceColor"&&Y.instanceColor&&(me=Y.instanceColor));let Xe={};Xe.attribute=me,me&&me.data&&(Xe.data=me.data),ie[re]=Xe,ne++}o.attributes=ie,o.attributesNum=ne,o.index=z}function R(){let Y=o.newAttributes;for(let J=0,ee=Y.length;J<ee;J++)Y[J]=0}function x(Y){y(Y,0)}function y(Y,J){let ee=o.newAttributes,z=o.enabledAttributes,ie=o.attributeDivisors;ee[Y]=1,z[Y]===0&&(i.enableVertexAttribArray(Y),z[Y]=1),ie[Y]!==J&&(i.vertexAttribDivisor(Y,J),ie[Y]=J)}function P(){let Y=o.newAttributes,J=o.enabledAttributes;for(let ee=0,z=J.length;ee<z;ee++)J[ee]!==Y[ee]&&(i.disableVertexAttribArray(ee),J[ee]=0)}function U(Y,J,ee,z,ie,G,ne){ne===!0?i.vertexAttribIPointer(Y,J,ee,ie,G):i.vertexAttribPointer(Y,J,ee,z,ie,G)}function I(Y,J,ee,z){R();let ie=z.attributes,G=ee.getAttributes(),ne=J.defaultAttributeValues;for(let Se in G){let re=G[Se];if(re.location>=0){let H=ie[Se];if(H===void 0&&(Se==="instanceMatrix"&&Y.instanceMatrix&&(H=Y.instanceMatrix),Se==="instanceColor"&&Y.instanceColor&&(H=Y.instanceColor)),H!==void 0){let me=H.normalized,Xe=H.itemSize,nt=e.get(H);if(nt===void 0)continue;let ue=nt.buffer,Fe=nt.type,Pe=nt.bytesPerElement,je=Fe===i.INT||Fe===i.UNSIGNED_INT||H.gpuType===vo;if(H.isInterleavedBufferAttribute){let Ue=H.data,rt=Ue.isInterleavedBuffer===!0?Ue.stride:Ue.itemSize,Gt=H.offset;if(Ue.isInstancedInterleavedBuffer||Ue.isInstancedBufferAttribute){for(let et=0;et<re.locationSize;et++)y(re.location+et,Ue.meshPerAttribute);Y.isInstancedMesh!==!0&&z._maxInstanceCount===void 0&&(z._maxInstanceCount=Ue.meshPerAttribute*Ue.count)}else for(let et=0;et<re.locationSize;et++)x(re.location+et);i.bindBuffer(i.ARRAY_BUFFER,ue);for(let et=0;et<re.locationSize;et++)U(re.location+et,Xe/re.locationSize,Fe,me,rt*Pe,(Gt+Xe/re.locationSize*et)*Pe,je)}else{if(H.isInstancedBufferAttribute){for(let Ue=0;Ue<re.locationSize;Ue++)y(re.location+Ue,H.meshPerAttribute);Y.isInstancedMesh!==!0&&z._maxInstanceCount===void 0&&(z._maxInstanceCount=H.meshPerAttribute*H.count)}else for(let Ue=0;Ue<re.locationSize;Ue++)x(re.location+Ue);i.bindBuffer(i.ARRAY_BUFFER,ue);for(let Ue=0;Ue<re.locationSize;Ue++)U(re.location+Ue,Xe/re.locationSize,Fe,me,Xe*Pe,Xe/re.locationSize*Ue*Pe,je)}}else if(ne!==void 0){let me=ne[Se];if(me!==void 0)switch(me.length){case 2:i.vertexAttrib2fv(re.location,me);break;case 3:i.vertexAttrib3fv(re.location,me);break;case 4:i.vertexAttrib4fv(re.location,me);break;default:i.vertexAttrib1fv(re.location,me)}}}}P()}function O(){q();for(let Y in n){let J=n[Y];for(let ee in J){let z=J[ee];for(let ie in z){let G=z[ie];for(let ne in G)p(G[ne].object),delete G[ne];delete z[ie]}}delete n[Y]}}function N(Y){if(n[Y.id]===void 0)return;let J=n[Y.id];for(let ee in J){let z=J[ee];for(let ie in z){let G=z[ie];for(let ne in G)p(G[ne].object),delete G[ne];delete z[ie]}}delete n[Y.id]}function b(Y){for(let J in n){let ee=n[J];for(let z in ee){let ie=ee[z];if(ie[Y.id]===void 0)continue;let G=ie[Y.id];for(let ne in G)p(G[ne].object),delete G[ne];delete ie[Y.id]}}}function L(Y){for(let J in n){let ee=n[J],z=Y.isInstancedMesh===!0?Y.id:0,ie=ee[z];if(ie!==void 0){for(let G in ie){let ne=ie[G];for(let Se in ne)p(ne[Se].object),delete ne[Se];delete ie[G]}delete ee[z],Object.keys(ee).length===0&&delete n[J]}}}function q(){k(),c=!0,o!==s&&(o=s,f(o.object))}function k(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:h,reset:q,resetDefaultState:k,dispose:O,releaseStatesOfGeometry:N,releaseStatesOfObject:L,releaseStatesOfProgram:b,initAttributes:R,enableAttribute:x,disableUnusedAttributes:P}}function qx(i,e,t){let n;function s(d){n=d}function o(d,f){i.drawArrays(n,d,f),t.update(f,n,1)}function c(d,f,p){p!==0&&(i.drawArraysInstanced(n,d,f,p),t.update(f,n,p))}function h(d,f,p){if(p===0)return;e.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,d,0,f,0,p);let g=0;for(let S=0;S<p;S++)g+=f[S];t.update(g,n,1)}this.setMode=s,this.render=o,this.renderInstances=c,this.renderMultiDraw=h}function Yx(i,e,t,n){let s;function o(){if(s!==void 0)return s;if(e.has("EXT_texture_filter_anisotropic")===!0){let b=e.get("EXT_texture_filter_anisotropic");s=i.getParameter(b.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function c(b){return!(b!==Hn&&n.convert(b)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function h(b){let L=b===Vn&&(e.has("EXT_color_buffer_half_float")||e.has("EXT_color_buffer_float"));return!(b!==Sn&&b!==Gn&&!L&&n.convert(b)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE))}function d(b){if(b==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";b="mediump"}return b==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let f=t.precision!==void 0?t.precision:"highp",p=d(f);p!==f&&(Qe("WebGLRenderer:",f,"not supported, using",p,"instead."),f=p);let _=t.reversedDepthBuffer===!0&&e.has("EXT_clip_control"),g=t.logarithmicDepthBuffer===!0&&_===!1;t.reversedDepthBuffer===!0&&_===!1&&Qe("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),t.logarithmicDepthBuffer===!0&&_===!0&&Qe("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let S=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),w=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),R=i.getParameter(i.MAX_TEXTURE_SIZE),x=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),y=i.getParameter(i.MAX_VERTEX_ATTRIBS),P=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),U=i.getParameter(i.MAX_VARYING_VECTORS),I=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),O=i.getParameter(i.MAX_SAMPLES),N=i.getParameter(i.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:o,getMaxPrecision:d,textureFormatReadable:c,textureTypeReadable:h,precision:f,logarithmicDepthBuffer:g,reversedDepthBuffer:_,maxTextures:S,maxVertexTextures:w,maxTextureSize:R,maxCubemapSize:x,maxAttributes:y,maxVertexUniforms:P,maxVaryings:U,maxFragmentUniforms:I,maxSamples:O,samples:N}}function jx(i){let e=this,t=null,n=0,s=!1,o=!1,c=new kn,h=new at,d={value:null,needsUpdate:!1};this.uniform=d,this.numPlanes=0,this.numIntersection=0,this.init=function(_,g){let S=_.length!==0||g||n!==0||s;return s=g,n=_.length,S},this.beginShadows=function(){o=!0,p(null)},this.endShadows=function(){o=!1},this.setGlobalState=function(_,g){t=p(_,g,0)},this.setState=function(_,g,S){let w=_.clippingPlanes,R=_.clipIntersection,x=_.clipShadows,y=i.get(_);if(!s||w===null||w.length===0||o&&!x)o?p(null):f();else{let P=o?0:n,U=P*4,I=y.clippingState||null;d.value=I,I=p(w,g,U,S);for(let O=0;O!==U;++O)I[O]=t[O];y.clippingState=I,this.numIntersection=R?this.numPlanes:0,this.numPlanes+=P}};function f(){d.value!==t&&(d.value=t,d.needsUpdate=n>0),e.numPlanes=n,e.numIntersection=0}function p(_,g,S,w){let R=_!==null?_.length:0,x=null;if(R!==0){if(x=d.value,w!==!0||x===null){let y=S+R*4,P=g.matrixWorldInverse;h.getNormalMatrix(P),(x===null||x.length<y)&&(x=new Float32Array(y));for(let U=0,I=S;U!==R;++U,I+=4)c.copy(_[U]).applyMatrix4(P,h),c.normal.toArray(x,I),x[I+3]=c.constant}d.value=x,d.needsUpdate=!0}return e.numPlanes=R,e.numIntersection=0,x}}var zs=class extends En{constructor(e=1,t={}){super(e,e,t),this.isWebGLCubeRenderTarget=!0;let n={width:e,height:e,depth:1},s=[n,n,n,n,n,n];this.texture=new vs(s),this._setTextureOptions(t),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(e,t){this.texture.type=t.type,this.texture.colorSpace=t.colorSpace,this.texture.generateMipmaps=t.generateMipmaps,this.texture.minFilter=t.minFilter,this.texture.magFilter=t.magFilter;let n={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new Di(5,5,5),o=new ii({name:"CubemapFromEquirect",uniforms:or(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:yn,blending:ir});o.uniforms.tEquirect.value=t;let c=new Ln(s,o),h=t.minFilter;return t.minFilter===xi&&(t.minFilter=_n),new Br(1,10,this).update(e,c),t.minFilter=h,c.geometry.dispose(),c.material.dispose(),this}clear(e,t=!0,n=!0,s=!0){let o=e.getRenderTarget();for(let c=0;c<6;c++)e.setRenderTarget(this,c),e.clear(t,n,s);e.setRenderTarget(o)}},pd=256,Jx=3,Zx=20,Od=256,Bd=16,Kx=3,Qx=new Q,eS=new ut,rl=class i{constructor(e){this._renderer=e,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new Br(1,10,null),this._boxMesh=new Ln(new Di(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(e,t=0,n=.1,s=100,o={}){let{size:c=256,position:h=Qx}=o,d=this._renderer;this._setSize(c);let f=this._allocateTarget(),p=this._getSourceTarget(!0);t>0&&(p.texture.mipmapsAutoUpdate=!1);let _=d.autoClear,g=d.autoClearColor,S=d.autoClearDepth,w=d.autoClearStencil,R=e.background;d.autoClear=!0,d.autoClearColor=!0,d.autoClearDepth=!0,d.autoClearStencil=!0,R===null&&(e.background=d.getClearColor(eS));let x=new Br(n,s,p);return x.position.copy(h),x.update(d,e),d.autoClear=_,d.autoClearColor=g,d.autoClearDepth=S,d.autoClearStencil=w,e.background=R,t>0&&(p.texture.mipmapsAutoUpdate=!0,this._blur(f,t)),this._applyPMREM(f),f}fromEquirectangular(e,t=null){return this._fromTexture(e,t)}fromCubemap(e,t=null){return this._fromTexture(e,t)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=_d(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=gd(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(e,t){return t>0?1-Math.sqrt(1-e/t):0}_setSize(e){this._cubeSize=Math.max(pd,Nc(e))}_fromTexture(e,t){e.mapping===sr||e.mapping===Vr?this._setSize(e.image.length===0?pd:e.image[0].width||e.image[0].image.width):this._setSize(e.image.width/4);let n=t||this._allocateTarget();return this._textureToCubemap(e),this._applyPMREM(n),n}_allocateTarget(){let e=this._cubeSize,t=md(e,!1,!1),n=Math.log2(e)-Jx;for(let s=0;s<=n;s++)t.texture.mipmaps.push({width:e>>s,height:e>>s});return t.texture.name="PMREM",t.texture.isPMREMTexture=!0,t}_getSourceTarget(e=!1){let t=this._cubeSize,n=this._sourceTarget;return(n===null||n.width!==t||e&&n.depthBuffer===!1)&&(n!==null&&n.dispose(),this._sourceTarget=md(t,!0,e)),this._sourceTarget}_compileMaterial(e){this._boxMesh.material=e,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(e,t,n){let s=this._boxMesh,o=this._cubeCamera;s.material=n,o.renderTarget=e,o.activeMipmapLevel=t;let c=e.width>>t;e.viewport.set(0,0,c,c),o.update(this._renderer,s),e.viewport.set(0,0,e.width,e.height)}_textureToCubemap(e){let t;e.mapping===sr||e.mapping===Vr?(this._cubemapMaterial===null&&(this._cubemapMaterial=_d()),t=this._cubemapMaterial,t.uniforms.flipEnvMap.value=e.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=gd()),t=this._equirectMaterial),t.uniforms.envMap.value=e,this._renderCube(this._getSourceTarget(),0,t)}_applyPMREM(e){this._ggxMaterial===null&&(this._ggxMaterial=tS(),this._integrationMaterial=nS());let t=this._cubeSize,n=e.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let o=this._integrationMaterial.uniforms;o.envMap.value=this._sourceTarget.texture,o.sourceLod.value=Math.log2(t/Bd);for(let c=0;c<=n;c++){let h=i.lodToRoughness(c,n);if(c>n-Kx)o.roughness.value=h,this._renderCube(e,c,this._integrationMaterial);else{let d=h>0?Math.log2(t)+.5*Math.log2(6/(Od*Math.pow(h,4)))+.5:0;s.roughness.value=h,s.lodBias.value=d,this._renderCube(e,c,this._ggxMaterial)}}}_blur(e,t){this._blurMaterial===null&&(this._blurMaterial=iS());let n=this._blurMaterial,s=n.uniforms,o=this._sourceTarget;s.sigma.value=Math.min(t,Math.PI)/Math.SQRT2,s.envMap.value=o.texture,this._renderCube(e,0,n),s.envMap.value=e.texture,this._renderCube(o,0,n)}};function md(i,e,t){return new zs(i,{minFilter:xi,generateMipmaps:e,type:Vn,colorSpace:hs,depthBuffer:t})}function Gs(i,e,t){return new ii({name:i,uniforms:e,vertexShader:mt.cube_vert,fragmentShader:t,side:yn,blending:ir,depthTest:!1,depthWrite:!1})}function tS(){return Gs("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${Od}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function nS(){return Gs("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:Bd}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function iS(){return Gs("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${Zx}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function gd(){return Gs("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function _d(){return Gs("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function rS(i){let e=new WeakMap,t=new WeakMap,n=null;function s(g,S=!1){return g==null?null:S?c(g):o(g)}function o(g){if(g&&g.isTexture){let S=g.mapping;if(S===mo||S===go)if(e.has(g)){let w=e.get(g).texture;return h(w,g.mapping)}else{let w=g.image;if(w&&w.height>0){let R=new zs(w.height);return R.fromEquirectangularTexture(i,g),e.set(g,R),g.addEventListener("dispose",f),h(R.texture,g.mapping)}else return null}}return g}function c(g){if(g&&g.isTexture&&g.isPMREMTexture!==!0){let S=g.mapping,w=S===mo||S===go,R=S===sr||S===Vr;if(w||R){let x=t.get(g),y=x!==void 0?x.texture.pmremVersion:0;if(g.isRenderTargetTexture&&g.pmremVersion!==y)return n===null&&(n=new rl(i)),x=w?n.fromEquirectangular(g,x):n.fromCubemap(g,x),x.texture.pmremVersion=g.pmremVersion,t.set(g,x),x.texture;if(x!==void 0)return x.texture;{let P=g.image;return w&&P&&P.height>0||R&&P&&d(P)?(n===null&&(n=new rl(i)),x=w?n.fromEquirectangular(g):n.fromCubemap(g),x.texture.pmremVersion=g.pmremVersion,t.set(g,x),g.addEventListener("dispose",p),x.texture):null}}}return g}function h(g,S){return S===mo?g.mapping=sr:S===go&&(g.mapping=Vr),g}function d(g){let S=0,w=6;for(let R=0;R<w;R++)g[R]!==void 0&&S++;return S===w}function f(g){let S=g.target;S.removeEventListener("dispose",f);let w=e.get(S);w!==void 0&&(e.delete(S),w.dispose())}function p(g){let S=g.target;S.removeEventListener("dispose",p);let w=t.get(S);w!==void 0&&(t.delete(S),w.dispose())}function _(){e=new WeakMap,t=new WeakMap,n!==null&&(n.dispose(),n=null)}return{get:s,dispose:_}}function sS(i){let e={};function t(n){if(e[n]!==void 0)return e[n];let s=i.getExtension(n);return e[n]=s,s}return{has:function(n){return t(n)!==null},init:function(){t("EXT_color_buffer_float"),t("WEBGL_clip_cull_distance"),t("OES_texture_float_linear"),t("EXT_color_buffer_half_float"),t("WEBGL_multisampled_render_to_texture"),t("WEBGL_render_shared_exponent")},get:function(n){let s=t(n);return s===null&&as("WebGLRenderer: "+n+" extension not supported."),s}}}function aS(i,e,t,n){let s={},o=new WeakMap,c=new FinalizationRegistry(w=>delete s[w]);function h(w){d(w.target)}function d(w){w.index!==null&&e.remove(w.index);for(let x in w.attributes)e.remove(w.attributes[x]);w.removeEventListener("dispose",h),delete s[w.id],c.unregister(w);let R=o.get(w);R&&(e.remove(R),o.delete(w)),n.releaseStatesOfGeometry(w),w.isInstancedBufferGeometry===!0&&delete w._maxInstanceCount,t.memory.geometries--}function f(w,R){return s[R.id]!==void 0||(R.addEventListener("dispose",h),s[R.id]=new WeakRef(R),c.register(R,R.id,R),t.memory.geometries++),R}function p(w){let R=w.attributes;for(let x in R)e.update(R[x],i.ARRAY_BUFFER)}function _(w){let R=w.index,x=w.attributes.position,y=0;if(x===void 0)return;let P=R!==null?R.array.length:x.array.length/3-1,U=x.count>=65535?gs:ms,I=new U(Math.ceil(P/3)*6,1),O=I.array;if(R!==null){let b=R.array;y=R.version;for(let L=0,q=0;L<P;L+=3){let k=b[L+0],Y=b[L+1],J=b[L+2];O[q++]=k,O[q++]=Y,O[q++]=Y,O[q++]=J,O[q++]=J,O[q++]=k}}else{y=x.version;for(let b=0,L=0;b<P;b+=3){let q=b+0,k=b+1,Y=b+2;O[L++]=q,O[L++]=k,O[L++]=k,O[L++]=Y,O[L++]=Y,O[L++]=q}}I.version=y;let N=o.get(w);N&&e.remove(N),o.set(w,I)}function g(w){let R=o.get(w);if(R){let x=w.index;x!==null&&R.version<x.version&&_(w)}else _(w);return o.get(w)}function S(){for(let w in s){let R=s[w].deref();R!==void 0&&d(R)}}return{get:f,update:p,getWireframeAttribute:g,dispose:S}}function oS(i,e,t){let n;function s(_){n=_}let o,c;function h(_){o=_.type,c=_.bytesPerElement}function d(_,g){i.drawElements(n,g,o,_*c),t.update(g,n,1)}function f(_,g,S){S!==0&&(i.drawElementsInstanced(n,g,o,_*c,S),t.update(g,n,S))}function p(_,g,S){if(S===0)return;e.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,g,0,o,_,0,S);let R=0;for(let x=0;x<S;x++)R+=g[x];t.update(R,n,1)}this.setMode=s,this.setIndex=h,this.render=d,this.renderInstances=f,this.renderMultiDraw=p}function lS(i){let e={geometries:0,textures:0},t={frame:0,calls:0,triangles:0,points:0,lines:0};function n(o,c,h){switch(t.calls++,c){case i.TRIANGLES:t.triangles+=h*(o/3);break;case i.LINES:t.lines+=h*(o/2);break;case i.LINE_STRIP:t.lines+=h*(o-1);break;case i.LINE_LOOP:t.lines+=h*o;break;case i.POINTS:t.points+=h*o;break;default:tt("WebGLInfo: Unknown draw mode:",c);break}}function s(){t.calls=0,t.triangles=0,t.points=0,t.lines=0}return{memory:e,render:t,programs:null,autoReset:!0,reset:s,update:n}}function cS(i,e,t){let n=new WeakMap,s=new zt;function o(c,h,d){let f=c.morphTargetInfluences,p=h.morphAttributes.position||h.morphAttributes.normal||h.morphAttributes.color,_=p!==void 0?p.length:0,g=n.get(h);if(g===void 0||g.count!==_){let q=function(){b.dispose(),n.delete(h),h.removeEventListener("dispose",q)};g!==void 0&&g.texture.dispose();let S=h.morphAttributes.position!==void 0,w=h.morphAttributes.normal!==void 0,R=h.morphAttributes.color!==void 0,x=h.morphAttributes.position||[],y=h.morphAttributes.normal||[],P=h.morphAttributes.color||[],U=0;S===!0&&(U=1),w===!0&&(U=2),R===!0&&(U=3);let I=h.attributes.position.count*U,O=1;I>e.maxTextureSize&&(O=Math.ceil(I/e.maxTextureSize),I=e.maxTextureSize);let N=new Float32Array(I*O*4*_),b=new fs(N,I,O,_);b.type=Gn,b.needsUpdate=!0;let L=U*4;for(let k=0;k<_;k++){let Y=x[k],J=y[k],ee=P[k],z=I*O*4*k;for(let ie=0;ie<Y.count;ie++){let G=ie*L;S===!0&&(s.fromBufferAttribute(Y,ie),N[z+G+0]=s.x,N[z+G+1]=s.y,N[z+G+2]=s.z,N[z+G+3]=0),w===!0&&(s.fromBufferAttribute(J,ie),N[z+G+4]=s.x,N[z+G+5]=s.y,N[z+G+6]=s.z,N[z+G+7]=0),R===!0&&(s.fromBufferAttribute(ee,ie),N[z+G+8]=s.x,N[z+G+9]=s.y,N[z+G+10]=s.z,N[z+G+11]=ee.itemSize===4?s.w:1)}}g={count:_,texture:b,size:new gt(I,O)},n.set(h,g),h.addEventListener("dispose",q)}if(c.isInstancedMesh===!0&&c.morphTexture!==null)d.getUniforms().setValue(i,"morphTexture",c.morphTexture,t);else{let S=0;for(let R=0;R<f.length;R++)S+=f[R];let w=h.morphTargetsRelative?1:1-S;d.getUniforms().setValue(i,"morphTargetBaseInfluence",w),d.getUniforms().setValue(i,"morphTargetInfluences",f)}d.getUniforms().setValue(i,"morphTargetsTexture",g.texture,t),d.getUniforms().setValue(i,"morphTargetsTextureSize",g.size)}return{update:o}}function hS(i,e,t,n,s){let o=new WeakMap;function c(f){let p=s.render.frame,_=f.geometry,g=e.get(f,_);if(o.get(g)!==p&&(e.update(g),o.set(g,p)),f.isInstancedMesh&&(f.hasEventListener("dispose",d)===!1&&f.addEventListener("dispose",d),o.get(f)!==p&&(t.update(f.instanceMatrix,i.ARRAY_BUFFER),f.instanceColor!==null&&t.update(f.instanceColor,i.ARRAY_BUFFER),o.set(f,p))),f.isSkinnedMesh){let S=f.skeleton;o.get(S)!==p&&(S.update(),o.set(S,p))}return g}function h(){o=new WeakMap}function d(f){let p=f.target;p.removeEventListener("dispose",d),n.releaseStatesOfObject(p),t.remove(p.instanceMatrix),p.instanceColor!==null&&t.remove(p.instanceColor)}return{update:c,dispose:h}}var uS={[pc]:"LINEAR_TONE_MAPPING",[mc]:"REINHARD_TONE_MAPPING",[gc]:"CINEON_TONE_MAPPING",[_c]:"ACES_FILMIC_TONE_MAPPING",[yc]:"AGX_TONE_MAPPING",[xc]:"NEUTRAL_TONE_MAPPING",[vc]:"CUSTOM_TONE_MAPPING"};function dS(i,e,t,n,s,o){let c=new En(e,t,{type:i,depthBuffer:s,stencilBuffer:o,samples:n?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),h=null,d=null,f=null,p=new vn;p.setAttribute("position",new Wt([-1,3,0,-1,-1,0,3,-1,0],3)),p.setAttribute("uv",new Wt([0,2,0,0,2,0],2));let _=new Qa({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),g=new Ln(p,_),S=new Rs(-1,1,1,-1,0,1),w=null,R=null,x=!1,y,P=null,U=[],I=!1;this.setSize=function(O,N){c.setSize(O,N),h!==null&&h.setSize(O,N),d!==null&&d.setSize(O,N);for(let b=0;b<U.length;b++){let L=U[b];L.setSize&&L.setSize(O,N)}},this.setEffects=function(O){U=O,I=U.length>0&&U[0].isRenderPass===!0;let N=c.width,b=c.height;U.length>0&&h===null&&(h=new En(N,b,{type:Vn,depthBuffer:!1,stencilBuffer:!1}),d=new En(N,b,{type:Vn,depthBuffer:!1,stencilBuffer:!1}));let L=s===!0&&U.some(q=>q.needsDepthTexture===!0);L!==(c.depthTexture!==null)&&(L===!0&&f===null&&(f=new yi(N,b),o===!0&&(f.format=Si,f.type=ar)),c.dispose(),c.depthTexture=L?f:null,c.resolveDepthBuffer=L,c.storeMultisampledDepthBuffer=L);for(let q=0;q<U.length;q++){let k=U[q];k.setSize&&k.setSize(N,b),L&&k.needsDepthTexture===!0&&k.setDepthTexture&&k.setDepthTexture(f)}},this.begin=function(O,N){if(x||O.toneMapping===si&&U.length===0)return!1;if(P=N,N!==null){let b=N.width,L=N.height;(c.width!==b||c.height!==L)&&this.setSize(b,L)}return I===!1&&O.setRenderTarget(c),y=O.toneMapping,O.toneMapping=si,!0},this.hasRenderPass=function(){return I},this.end=function(O,N){O.toneMapping=y,x=!0;let b=c,L=h;for(let q=0;q<U.length;q++){let k=U[q];k.enabled!==!1&&(k.render(O,L,b,N),k.needsSwap!==!1&&(b=L,L=L===h?d:h))}if(w!==O.outputColorSpace||R!==O.toneMapping){w=O.outputColorSpace,R=O.toneMapping,_.defines={},yt.getTransfer(w)===Ct&&(_.defines.SRGB_TRANSFER="");let q=uS[R];q&&(_.defines[q]=""),_.needsUpdate=!0}_.uniforms.tDiffuse.value=b.texture,O.setRenderTarget(P),O.render(g,S),P=null,x=!1},this.isCompositing=function(){return x},this.dispose=function(){c.dispose(),h!==null&&h.dispose(),d!==null&&d.dispose(),p.dispose(),_.dispose()}}var kd=new xn,zd=new yi(1,1),Gd=new ys(1),Vd=new fs,Hd=new qa,Wd=new vs,vd=[],yd=[],xd=new Float32Array(16),Sd=new Float32Array(9),Md=new Float32Array(4);function $r(i,e,t){let n=i[0];if(n<=0||n>0)return i;let s=e*t,o=vd[s];if(o===void 0&&(o=new Float32Array(s),vd[s]=o),e!==0){n.toArray(o,0);for(let c=1,h=0;c!==e;++c)h+=t,i[c].toArray(o,h)}return o}function Zt(i,e){if(i.length!==e.length)return!1;for(let t=0,n=i.length;t<n;t++)if(i[t]!==e[t])return!1;return!0}function Kt(i,e){for(let t=0,n=e.length;t<n;t++)i[t]=e[t]}function al(i,e){let t=yd[e];t===void 0&&(t=new Int32Array(e),yd[e]=t);for(let n=0;n!==e;++n)t[n]=i.allocateTextureUnit();return t}function fS(i,e){let t=this.cache;t[0]!==e&&(i.uniform1f(this.addr,e),t[0]=e)}function pS(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2f(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Zt(t,e))return;i.uniform2fv(this.addr,e),Kt(t,e)}}function mS(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3f(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else if(e.r!==void 0)(t[0]!==e.r||t[1]!==e.g||t[2]!==e.b)&&(i.uniform3f(this.addr,e.r,e.g,e.b),t[0]=e.r,t[1]=e.g,t[2]=e.b);else{if(Zt(t,e))return;i.uniform3fv(this.addr,e),Kt(t,e)}}function gS(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4f(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Zt(t,e))return;i.uniform4fv(this.addr,e),Kt(t,e)}}function _S(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(Zt(t,e))return;i.uniformMatrix2fv(this.addr,!1,e),Kt(t,e)}else{if(Zt(t,n))return;Md.set(n),i.uniformMatrix2fv(this.addr,!1,Md),Kt(t,n)}}function vS(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(Zt(t,e))return;i.uniformMatrix3fv(this.addr,!1,e),Kt(t,e)}else{if(Zt(t,n))return;Sd.set(n),i.uniformMatrix3fv(this.addr,!1,Sd),Kt(t,n)}}function yS(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(Zt(t,e))return;i.uniformMatrix4fv(this.addr,!1,e),Kt(t,e)}else{if(Zt(t,n))return;xd.set(n),i.uniformMatrix4fv(this.addr,!1,xd),Kt(t,n)}}function xS(i,e){let t=this.cache;t[0]!==e&&(i.uniform1i(this.addr,e),t[0]=e)}function SS(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2i(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Zt(t,e))return;i.uniform2iv(this.addr,e),Kt(t,e)}}function MS(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3i(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(Zt(t,e))return;i.uniform3iv(this.addr,e),Kt(t,e)}}function bS(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4i(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Zt(t,e))return;i.uniform4iv(this.addr,e),Kt(t,e)}}function wS(i,e){let t=this.cache;t[0]!==e&&(i.uniform1ui(this.addr,e),t[0]=e)}function ES(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2ui(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(Zt(t,e))return;i.uniform2uiv(this.addr,e),Kt(t,e)}}function TS(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3ui(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(Zt(t,e))return;i.uniform3uiv(this.addr,e),Kt(t,e)}}function AS(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4ui(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(Zt(t,e))return;i.uniform4uiv(this.addr,e),Kt(t,e)}}function ol(i){return i.version===0&&(i.compareFunction=Ic,i.needsUpdate=!0),i}function CS(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let o;this.type===i.SAMPLER_2D_SHADOW?o=ol(zd):o=kd,t.setTexture2D(e||o,s)}function RS(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),t.setTexture3D(e||Hd,s)}function PS(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let o;this.type===i.SAMPLER_CUBE_SHADOW?o=ol(Gd):o=Wd,t.setTextureCube(e||o,s)}function IS(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),t.setTexture2DArray(e||Vd,s)}function LS(i){switch(i){case 5126:return fS;case 35664:return pS;case 35665:return mS;case 35666:return gS;case 35674:return _S;case 35675:return vS;case 35676:return yS;case 5124:case 35670:return xS;case 35667:case 35671:return SS;case 35668:case 35672:return MS;case 35669:case 35673:return bS;case 5125:return wS;case 36294:return ES;case 36295:return TS;case 36296:return AS;case 35678:case 36198:case 36298:case 36306:case 35682:return CS;case 35679:case 36299:case 36307:return RS;case 35680:case 36300:case 36308:case 36293:return PS;case 36289:case 36303:case 36311:case 36292:return IS}}function DS(i,e){i.uniform1fv(this.addr,e)}function FS(i,e){let t=$r(e,this.size,2);i.uniform2fv(this.addr,t)}function NS(i,e){let t=$r(e,this.size,3);i.uniform3fv(this.addr,t)}function US(i,e){let t=$r(e,this.size,4);i.uniform4fv(this.addr,t)}function OS(i,e){let t=$r(e,this.size,4);i.uniformMatrix2fv(this.addr,!1,t)}function BS(i,e){let t=$r(e,this.size,9);i.uniformMatrix3fv(this.addr,!1,t)}function kS(i,e){let t=$r(e,this.size,16);i.uniformMatrix4fv(this.addr,!1,t)}function zS(i,e){i.uniform1iv(this.addr,e)}function GS(i,e){i.uniform2iv(this.addr,e)}function VS(i,e){i.uniform3iv(this.addr,e)}function HS(i,e){i.uniform4iv(this.addr,e)}function WS(i,e){i.uniform1uiv(this.addr,e)}function XS(i,e){i.uniform2uiv(this.addr,e)}function $S(i,e){i.uniform3uiv(this.addr,e)}function qS(i,e){i.uniform4uiv(this.addr,e)}function YS(i,e,t){let n=this.cache,s=e.length,o=al(t,s);Zt(n,o)||(i.uniform1iv(this.addr,o),Kt(n,o));let c;this.type===i.SAMPLER_2D_SHADOW?c=ol(zd):c=kd;for(let h=0;h!==s;++h)t.setTexture2D(e[h]||c,o[h])}function jS(i,e,t){let n=this.cache,s=e.length,o=al(t,s);Zt(n,o)||(i.uniform1iv(this.addr,o),Kt(n,o));for(let c=0;c!==s;++c)t.setTexture3D(e[c]||Hd,o[c])}function JS(i,e,t){let n=this.cache,s=e.length,o=al(t,s);Zt(n,o)||(i.uniform1iv(this.addr,o),Kt(n,o));let c;this.type===i.SAMPLER_CUBE_SHADOW?c=ol(Gd):c=Wd;for(let h=0;h!==s;++h)t.setTextureCube(e[h]||c,o[h])}function ZS(i,e,t){let n=this.cache,s=e.length,o=al(t,s);Zt(n,o)||(i.uniform1iv(this.addr,o),Kt(n,o));for(let c=0;c!==s;++c)t.setTexture2DArray(e[c]||Vd,o[c])}function KS(i){switch(i){case 5126:return DS;case 35664:return FS;case 35665:return NS;case 35666:return US;case 35674:return OS;case 35675:return BS;case 35676:return kS;case 5124:case 35670:return zS;case 35667:case 35671:return GS;case 35668:case 35672:return VS;case 35669:case 35673:return HS;case 5125:return WS;case 36294:return XS;case 36295:return $S;case 36296:return qS;case 35678:case 36198:case 36298:case 36306:case 35682:return YS;case 35679:case 36299:case 36307:return jS;case 35680:case 36300:case 36308:case 36293:return JS;case 36289:case 36303:case 36311:case 36292:return ZS}}var Hc=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.setValue=LS(t.type)}},Wc=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.size=t.size,this.setValue=KS(t.type)}},Xc=class{constructor(e){this.id=e,this.seq=[],this.map={}}setValue(e,t,n){let s=this.seq;for(let o=0,c=s.length;o!==c;++o){let h=s[o];h.setValue(e,t[h.id],n)}}},Gc=/(\w+)(\])?(\[|\.)?/g;function bd(i,e){i.seq.push(e),i.map[e.id]=e}function QS(i,e,t){let n=i.name,s=n.length;for(Gc.lastIndex=0;;){let o=Gc.exec(n),c=Gc.lastIndex,h=o[1],d=o[2]==="]",f=o[3];if(d&&(h=h|0),f===void 0||f==="["&&c+2===s){bd(t,f===void 0?new Hc(h,i,e):new Wc(h,i,e));break}else{let _=t.map[h];_===void 0&&(_=new Xc(h),bd(t,_)),t=_}}}var Xr=class{constructor(e,t){this.seq=[],this.map={};let n=e.getProgramParameter(t,e.ACTIVE_UNIFORMS);for(let c=0;c<n;++c){let h=e.getActiveUniform(t,c),d=e.getUniformLocation(t,h.name);QS(h,d,this)}let s=[],o=[];for(let c of this.seq)c.type===e.SAMPLER_2D_SHADOW||c.type===e.SAMPLER_CUBE_SHADOW||c.type===e.SAMPLER_2D_ARRAY_SHADOW?s.push(c):o.push(c);s.length>0&&(this.seq=s.concat(o))}setValue(e,t,n,s){let o=this.map[t];o!==void 0&&o.setValue(e,n,s)}setOptional(e,t,n){let s=t[n];s!==void 0&&this.setValue(e,n,s)}static upload(e,t,n,s){for(let o=0,c=t.length;o!==c;++o){let h=t[o],d=n[h.id];d.needsUpdate!==!1&&h.setValue(e,d.value,s)}}static seqWithValue(e,t){let n=[];for(let s=0,o=e.length;s!==o;++s){let c=e[s];c.id in t&&n.push(c)}return n}};function wd(i,e,t){let n=i.createShader(e);return i.shaderSource(n,t),i.compileShader(n),n}var eM=37297,tM=0;function nM(i,e){let t=i.split(`
`),n=[],s=Math.max(e-6,0),o=Math.min(e+6,t.length);for(let c=s;c<o;c++){let h=c+1;n.push(`${h===e?">":" "} ${h}: ${t[c]}`)}return n.join(`
`)}var Ed=new at;function iM(i){yt._getMatrix(Ed,yt.workingColorSpace,i);let e=`mat3( ${Ed.elements.map(t=>t.toFixed(4))} )`;switch(yt.getTransfer(i)){case us:return[e,"LinearTransferOETF"];case Ct:return[e,"sRGBTransferOETF"];default:return Qe("WebGLProgram: Unsupported color space: ",i),[e,"LinearTransferOETF"]}}function Td(i,e,t){let n=i.getShaderParameter(e,i.COMPILE_STATUS),o=(i.getShaderInfoLog(e)||"").trim();if(n&&o==="")return"";let c=/ERROR: 0:(\d+)/.exec(o);if(c){let h=parseInt(c[1]);return t.toUpperCase()+`

`+o+`

`+nM(i.getShaderSource(e),h)}else return o}function rM(i,e){let t=iM(e);return[`vec4 ${i}( vec4 value ) {`,`	return ${t[1]}( vec4( ${t[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var sM={[pc]:"Linear",[mc]:"Reinhard",[gc]:"Cineon",[_c]:"ACESFilmic",[yc]:"AgX",[xc]:"Neutral",[vc]:"Custom"};function aM(i,e){let t=sM[e];return t===void 0?(Qe("WebGLProgram: Unsupported toneMapping:",e),"vec3 "+i+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+i+"( vec3 color ) { return "+t+"ToneMapping( color ); }"}var il=new Q;function oM(){yt.getLuminanceCoefficients(il);let i=il.x.toFixed(4),e=il.y.toFixed(4),t=il.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${e}, ${t} );`,"	return dot( weights, rgb );","}"].join(`
`)}function lM(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(ks).join(`
`)}function cM(i){let e=[];for(let t in i){let n=i[t];n!==!1&&e.push("#define "+t+" "+n)}return e.join(`
`)}function hM(i,e){let t={},n=i.getProgramParameter(e,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){let o=i.getActiveAttrib(e,s),c=o.name,h=1;o.type===i.FLOAT_MAT2&&(h=2),o.type===i.FLOAT_MAT3&&(h=3),o.type===i.FLOAT_MAT4&&(h=4),t[c]={type:o.type,location:i.getAttribLocation(e,c),locationSize:h}}return t}function ks(i){return i!==""}function Ad(i,e){let t=e.numSpotLightShadows+e.numSpotLightMaps-e.numSpotLightShadowsWithMaps;return i.replace(/NUM_SUN_LIGHTS/g,e.numSunLights).replace(/NUM_DIR_LIGHTS/g,e.numDirLights).replace(/NUM_SPOT_LIGHTS/g,e.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,e.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,t).replace(/NUM_RECT_AREA_LIGHTS/g,e.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,e.numPointLights).replace(/NUM_HEMI_LIGHTS/g,e.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,e.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,e.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,e.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,e.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,e.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,e.numLightProbeGrids)}function Cd(i,e){return i.replace(/NUM_CLIPPING_PLANES/g,e.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,e.numClippingPlanes-e.numClipIntersection)}var uM=/^[ \t]*#include +<([\w\d./]+)>/gm;function $c(i){return i.replace(uM,dM)}function dM(i,e){let t=mt[e];if(t===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+e+">");return $c(t)}var fM=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function Rd(i){return i.replace(fM,pM)}function pM(i,e,t,n){let s="";for(let o=parseInt(e);o<parseInt(t);o++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+o+" ]").replace(/UNROLLED_LOOP_INDEX/g,o);return s}function Pd(i){let e=`precision ${i.precision} float;
	precision ${i.precision} int;
	precision ${i.precision} sampler2D;
	precision ${i.precision} samplerCube;
	precision ${i.precision} sampler3D;
	precision ${i.precision} sampler2DArray;
	precision ${i.precision} sampler2DShadow;
	precision ${i.precision} samplerCubeShadow;
	precision ${i.precision} sampler2DArrayShadow;
	precision ${i.precision} isampler2D;
	precision ${i.precision} isampler3D;
	precision ${i.precision} isamplerCube;
	precision ${i.precision} isampler2DArray;
	precision ${i.precision} usampler2D;
	precision ${i.precision} usampler3D;
	precision ${i.precision} usamplerCube;
	precision ${i.precision} usampler2DArray;
	`;return i.precision==="highp"?e+=`
#define HIGH_PRECISION`:i.precision==="mediump"?e+=`
#define MEDIUM_PRECISION`:i.precision==="lowp"&&(e+=`
#define LOW_PRECISION`),e}var mM={[nr]:"SHADOWMAP_TYPE_PCF",[zr]:"SHADOWMAP_TYPE_VSM"};function gM(i){return mM[i.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var _M={[Vr]:"ENVMAP_MODE_REFRACTION"};function vM(i){return i.envMap===!1?"ENVMAP_MODE_REFLECTION":_M[i.envMapMode]||"ENVMAP_MODE_REFLECTION"}var yM={[fc]:"ENVMAP_BLENDING_MULTIPLY",[$u]:"ENVMAP_BLENDING_MIX",[qu]:"ENVMAP_BLENDING_ADD"};function xM(i){return i.envMap===!1?"ENVMAP_BLENDING_NONE":yM[i.combine]||"ENVMAP_BLENDING_NONE"}function SM(i,e,t,n){let s=i.getContext(),o=t.defines,c=t.vertexShader,h=t.fragmentShader,d=gM(t),f=t.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",p=vM(t),_=xM(t),g=lM(t),S=cM(o),w=s.createProgram(),R,x,y=t.glslVersion?"#version "+t.glslVersion+`
`:"";t.isRawShaderMaterial?(R=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,S].filter(ks).join(`
`),R.length>0&&(R+=`
`),x=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,S].filter(ks).join(`
`),x.length>0&&(x+=`
`)):(R=[Pd(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,S,t.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",t.batching?"#define USE_BATCHING":"",t.batchingColor?"#define USE_BATCHING_COLOR":"",t.instancing?"#define USE_INSTANCING":"",t.instancingColor?"#define USE_INSTANCING_COLOR":"",t.instancingMorph?"#define USE_INSTANCING_MORPH":"",t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.map?"#define USE_MAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+p:"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.displacementMap?"#define USE_DISPLACEMENTMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.mapUv?"#define MAP_UV "+t.mapUv:"",t.alphaMapUv?"#define ALPHAMAP_UV "+t.alphaMapUv:"",t.lightMapUv?"#define LIGHTMAP_UV "+t.lightMapUv:"",t.aoMapUv?"#define AOMAP_UV "+t.aoMapUv:"",t.emissiveMapUv?"#define EMISSIVEMAP_UV "+t.emissiveMapUv:"",t.bumpMapUv?"#define BUMPMAP_UV "+t.bumpMapUv:"",t.normalMapUv?"#define NORMALMAP_UV "+t.normalMapUv:"",t.displacementMapUv?"#define DISPLACEMENTMAP_UV "+t.displacementMapUv:"",t.metalnessMapUv?"#define METALNESSMAP_UV "+t.metalnessMapUv:"",t.roughnessMapUv?"#define ROUGHNESSMAP_UV "+t.roughnessMapUv:"",t.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+t.anisotropyMapUv:"",t.clearcoatMapUv?"#define CLEARCOATMAP_UV "+t.clearcoatMapUv:"",t.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+t.clearcoatNormalMapUv:"",t.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+t.clearcoatRoughnessMapUv:"",t.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+t.diffuseRoughnessMapUv:"",t.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+t.iridescenceMapUv:"",t.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+t.iridescenceThicknessMapUv:"",t.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+t.sheenColorMapUv:"",t.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+t.sheenRoughnessMapUv:"",t.specularMapUv?"#define SPECULARMAP_UV "+t.specularMapUv:"",t.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+t.specularColorMapUv:"",t.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+t.specularIntensityMapUv:"",t.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+t.transmissionMapUv:"",t.thicknessMapUv?"#define THICKNESSMAP_UV "+t.thicknessMapUv:"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexNormals?"#define HAS_NORMAL":"",t.vertexColors?"#define USE_COLOR":"",t.vertexAlphas?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.flatShading?"#define FLAT_SHADED":"",t.skinning?"#define USE_SKINNING":"",t.morphTargets?"#define USE_MORPHTARGETS":"",t.morphNormals&&t.flatShading===!1?"#define USE_MORPHNORMALS":"",t.morphColors?"#define USE_MORPHCOLORS":"",t.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+t.morphTextureStride:"",t.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+t.morphTargetsCount:"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+d:"",t.sizeAttenuation?"#define USE_SIZEATTENUATION":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(ks).join(`
`),x=[Pd(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,S,t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",t.map?"#define USE_MAP":"",t.matcap?"#define USE_MATCAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+f:"",t.envMap?"#define "+p:"",t.envMap?"#define "+_:"",t.envMapPMREM?"#define ENVMAP_MAX_LOD "+t.envMapMaxLod+".0":"",t.envMapPMREM?"#define ENVMAP_SIZE "+t.envMapSize+".0":"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoat?"#define USE_CLEARCOAT":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.dispersion?"#define USE_DISPERSION":"",t.retroreflection?"#define USE_RETROREFLECTION":"",t.iridescence?"#define USE_IRIDESCENCE":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaTest?"#define USE_ALPHATEST":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.sheen?"#define USE_SHEEN":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexColors||t.instancingColor?"#define USE_COLOR":"",t.vertexAlphas||t.batchingColor?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.gradientMap?"#define USE_GRADIENTMAP":"",t.flatShading?"#define FLAT_SHADED":"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+d:"",t.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",t.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",t.toneMapping!==si?"#define TONE_MAPPING":"",t.toneMapping!==si?mt.tonemapping_pars_fragment:"",t.toneMapping!==si?aM("toneMapping",t.toneMapping):"",t.dithering?"#define DITHERING":"",t.opaque?"#define OPAQUE":"",mt.colorspace_pars_fragment,rM("linearToOutputTexel",t.outputColorSpace),oM(),t.useDepthPacking?"#define DEPTH_PACKING "+t.depthPacking:"",`
`].filter(ks).join(`
`)),c=$c(c),c=Ad(c,t),c=Cd(c,t),h=$c(h),h=Ad(h,t),h=Cd(h,t),c=Rd(c),h=Rd(h),t.isRawShaderMaterial!==!0&&(y=`#version 300 es
`,R=[g,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+R,x=["#define varying in",t.glslVersion===Lc?"":"layout(location = 0) out highp vec4 pc_fragColor;",t.glslVersion===Lc?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+x);let P=y+R+c,U=y+x+h,I=wd(s,s.VERTEX_SHADER,P),O=wd(s,s.FRAGMENT_SHADER,U);s.attachShader(w,I),s.attachShader(w,O),t.index0AttributeName!==void 0?s.bindAttribLocation(w,0,t.index0AttributeName):t.hasPositionAttribute===!0&&s.bindAttribLocation(w,0,"position"),s.linkProgram(w);function N(k){if(i.debug.checkShaderErrors){let Y=s.getProgramInfoLog(w)||"",J=s.getShaderInfoLog(I)||"",ee=s.getShaderInfoLog(O)||"",z=Y.trim(),ie=J.trim(),G=ee.trim(),ne=!0,Se=!0;if(s.getProgramParameter(w,s.LINK_STATUS)===!1)if(ne=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,w,I,O);else{let re=Td(s,I,"vertex"),H=Td(s,O,"fragment");tt("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(w,s.VALIDATE_STATUS)+`

Material Name: `+k.name+`
Material Type: `+k.type+`

Program Info Log: `+z+`
`+re+`
`+H)}else z!==""?Qe("WebGLProgram: Program Info Log:",z):(ie===""||G==="")&&(Se=!1);Se&&(k.diagnostics={runnable:ne,programLog:z,vertexShader:{log:ie,prefix:R},fragmentShader:{log:G,prefix:x}})}s.deleteShader(I),s.deleteShader(O),b=new Xr(s,w),L=hM(s,w)}let b;this.getUniforms=function(){return b===void 0&&N(this),b};let L;this.getAttributes=function(){return L===void 0&&N(this),L};let q=t.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return q===!1&&(q=s.getProgramParameter(w,eM)),q},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(w),this.program=void 0},this.type=t.shaderType,this.name=t.shaderName,this.id=tM++,this.cacheKey=e,this.usedTimes=1,this.program=w,this.vertexShader=I,this.fragmentShader=O,this}var MM=0,qc=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(e,t,n){let s=this._getShaderCacheForMaterial(e);return s.has(t)===!1&&(s.add(t),t.usedTimes++),s.has(n)===!1&&(s.add(n),n.usedTimes++),this}remove(e){let t=this.materialCache.get(e);for(let n of t)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(e),this}getVertexShaderStage(e){return this._getShaderStage(e.vertexShader)}getFragmentShaderStage(e){return this._getShaderStage(e.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(e){let t=this.materialCache,n=t.get(e);return n===void 0&&(n=new Set,t.set(e,n)),n}_getShaderStage(e){let t=this.shaderCache,n=t.get(e);return n===void 0&&(n=new Yc(e),t.set(e,n)),n}},Yc=class{constructor(e){this.id=MM++,this.code=e,this.usedTimes=0}};function bM(i){return i===Bi||i===Us||i===Os}function wM(i,e,t,n,s,o){let c=new Dr,h=new qc,d=new Set,f=[],p=new Map,_=n.logarithmicDepthBuffer,g={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function S(b){return d.add(b),b===0?"uv":`uv${b}`}function w(b,L,q,k,Y,J){let ee=k.fog,z=Y.geometry,ie=b.isMeshStandardMaterial||b.isMeshLambertMaterial||b.isMeshPhongMaterial?k.environment:null,G=b.isMeshStandardMaterial||b.isMeshLambertMaterial&&!b.envMap||b.isMeshPhongMaterial&&!b.envMap,ne=e.get(b.envMap||ie,G),Se=g[b.type],re=n.precision;b.precision!==null&&(re=n.getMaxPrecision(b.precision),re!==b.precision&&Qe("WebGLProgram.getParameters:",b.precision,"not supported, using",re,"instead."));let H=z.morphAttributes.position||z.morphAttributes.normal||z.morphAttributes.color,me=H!==void 0?H.length:0,Xe=0;z.morphAttributes.position!==void 0&&(Xe=1),z.morphAttributes.normal!==void 0&&(Xe=2),z.morphAttributes.color!==void 0&&(Xe=3);let nt,ue,Fe,Pe;if(Se){let Oe=oi[Se];nt=Oe.vertexShader,ue=Oe.fragmentShader}else{nt=b.vertexShader,ue=b.fragmentShader;let Oe=h.getVertexShaderStage(b),Et=h.getFragmentShaderStage(b);h.update(b,Oe,Et),Fe=Oe.id,Pe=Et.id}let je=i.getRenderTarget(),Ue=i.state.buffers.depth.getReversed(),rt=Y.isInstancedMesh===!0,Gt=Y.isBatchedMesh===!0,et=!!b.map,wt=!!b.matcap,Tt=!!ne,dt=Tt&&ne.isPMREMTexture===!0,Vt=!!b.aoMap,ht=!!b.lightMap,Rt=!!b.bumpMap&&b.wireframe===!1,St=!!b.normalMap,Qt=!!b.displacementMap,Le=!!b.emissiveMap,qe=!!b.metalnessMap,an=!!b.roughnessMap,en=b.anisotropy>0,W=b.clearcoat>0,fn=b.diffuseRoughness>0,At=b.dispersion>0,Nt=b.retroreflectivity>0,De=b.iridescence>0,Xt=b.sheen>0,Je=b.transmission>0,Ze=en&&!!b.anisotropyMap,D=W&&!!b.clearcoatMap,T=W&&!!b.clearcoatNormalMap,j=W&&!!b.clearcoatRoughnessMap,ve=fn&&!!b.diffuseRoughnessMap,de=De&&!!b.iridescenceMap,pe=De&&!!b.iridescenceThicknessMap,Me=Xt&&!!b.sheenColorMap,ae=Xt&&!!b.sheenRoughnessMap,le=!!b.specularMap,Ce=!!b.specularColorMap,B=!!b.specularIntensityMap,he=Je&&!!b.transmissionMap,se=Je&&!!b.thicknessMap,Re=!!b.gradientMap,Ee=!!b.alphaMap,Ae=b.alphaTest>0,$e=!!b.alphaHash,ot=!!b.extensions,we=si;b.toneMapped&&(je===null||je.isXRRenderTarget===!0)&&(we=i.toneMapping);let Ye=dt?ne.isCompressedCubeTexture?ne.image[0].mipmaps:ne.mipmaps:null,lt={shaderID:Se,shaderType:b.type,shaderName:b.name,vertexShader:nt,fragmentShader:ue,defines:b.defines,customVertexShaderID:Fe,customFragmentShaderID:Pe,isRawShaderMaterial:b.isRawShaderMaterial===!0,glslVersion:b.glslVersion,precision:re,batching:Gt,batchingColor:Gt&&Y._colorsTexture!==null,instancing:rt,instancingColor:rt&&Y.instanceColor!==null,instancingMorph:rt&&Y.morphTexture!==null,outputColorSpace:je===null?i.outputColorSpace:je.isXRRenderTarget===!0?je.texture.colorSpace:yt.workingColorSpace,alphaToCoverage:!!b.alphaToCoverage,map:et,matcap:wt,envMap:Tt,envMapMode:Tt&&ne.mapping,envMapPMREM:dt,envMapMaxLod:dt?Ye.length-1:null,envMapSize:dt?Ye[0].width:null,aoMap:Vt,lightMap:ht,bumpMap:Rt,normalMap:St,displacementMap:Qt,emissiveMap:Le,normalMapObjectSpace:St&&b.normalMapType===Ju,normalMapTangentSpace:St&&b.normalMapType===el,packedNormalMap:St&&b.normalMapType===el&&bM(b.normalMap.format),metalnessMap:qe,roughnessMap:an,anisotropy:en,anisotropyMap:Ze,clearcoat:W,clearcoatMap:D,clearcoatNormalMap:T,clearcoatRoughnessMap:j,diffuseRoughness:fn,diffuseRoughnessMap:ve,dispersion:At,retroreflection:Nt,iridescence:De,iridescenceMap:de,iridescenceThicknessMap:pe,sheen:Xt,sheenColorMap:Me,sheenRoughnessMap:ae,specularMap:le,specularColorMap:Ce,specularIntensityMap:B,transmission:Je,transmissionMap:he,thicknessMap:se,gradientMap:Re,opaque:b.transparent===!1&&b.blending===Gr&&b.alphaToCoverage===!1,alphaMap:Ee,alphaTest:Ae,alphaHash:$e,combine:b.combine,mapUv:et&&S(b.map.channel),aoMapUv:Vt&&S(b.aoMap.channel),lightMapUv:ht&&S(b.lightMap.channel),bumpMapUv:Rt&&S(b.bumpMap.channel),normalMapUv:St&&S(b.normalMap.channel),displacementMapUv:Qt&&S(b.displacementMap.channel),emissiveMapUv:Le&&S(b.emissiveMap.channel),metalnessMapUv:qe&&S(b.metalnessMap.channel),roughnessMapUv:an&&S(b.roughnessMap.channel),anisotropyMapUv:Ze&&S(b.anisotropyMap.channel),clearcoatMapUv:D&&S(b.clearcoatMap.channel),clearcoatNormalMapUv:T&&S(b.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:j&&S(b.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:ve&&S(b.diffuseRoughnessMap.channel),iridescenceMapUv:de&&S(b.iridescenceMap.channel),iridescenceThicknessMapUv:pe&&S(b.iridescenceThicknessMap.channel),sheenColorMapUv:Me&&S(b.sheenColorMap.channel),sheenRoughnessMapUv:ae&&S(b.sheenRoughnessMap.channel),specularMapUv:le&&S(b.specularMap.channel),specularColorMapUv:Ce&&S(b.specularColorMap.channel),specularIntensityMapUv:B&&S(b.specularIntensityMap.channel),transmissionMapUv:he&&S(b.transmissionMap.channel),thicknessMapUv:se&&S(b.thicknessMap.channel),alphaMapUv:Ee&&S(b.alphaMap.channel),vertexTangents:!!z.attributes.tangent&&(St||en),vertexNormals:!!z.attributes.normal,vertexColors:b.vertexColors,vertexAlphas:b.vertexColors===!0&&!!z.attributes.color&&z.attributes.color.itemSize===4,pointsUvs:Y.isPoints===!0&&!!z.attributes.uv&&(et||Ee),fog:!!ee,useFog:b.fog===!0,fogExp2:!!ee&&ee.isFogExp2,flatShading:b.wireframe===!1&&(b.flatShading===!0||z.attributes.normal===void 0&&St===!1&&(b.isMeshLambertMaterial||b.isMeshPhongMaterial||b.isMeshStandardMaterial||b.isMeshPhysicalMaterial)),sizeAttenuation:b.sizeAttenuation===!0,logarithmicDepthBuffer:_,reversedDepthBuffer:Ue,skinning:Y.isSkinnedMesh===!0,hasPositionAttribute:z.attributes.position!==void 0,morphTargets:z.morphAttributes.position!==void 0,morphNormals:z.morphAttributes.normal!==void 0,morphColors:z.morphAttributes.color!==void 0,morphTargetsCount:me,morphTextureStride:Xe,numSunLights:L.sun.length,numDirLights:L.directional.length,numPointLights:L.point.length,numSpotLights:L.spot.length,numSpotLightMaps:L.spotLightMap.length,numRectAreaLights:L.rectArea.length,numHemiLights:L.hemi.length,numSunLightShadows:L.sunShadowMap.length,numDirLightShadows:L.directionalShadowMap.length,numPointLightShadows:L.pointShadowMap.length,numSpotLightShadows:L.spotShadowMap.length,numSpotLightShadowsWithMaps:L.numSpotLightShadowsWithMaps,numLightProbes:L.numLightProbes,numLightProbeGrids:J.filter(Oe=>Oe.texture!==null).length,numClippingPlanes:o.numPlanes,numClipIntersection:o.numIntersection,dithering:b.dithering,shadowMapEnabled:i.shadowMap.enabled&&q.length>0,shadowMapType:i.shadowMap.type,toneMapping:we,decodeVideoTexture:et&&b.map.isVideoTexture===!0&&yt.getTransfer(b.map.colorSpace)===Ct,decodeVideoTextureEmissive:Le&&b.emissiveMap.isVideoTexture===!0&&yt.getTransfer(b.emissiveMap.colorSpace)===Ct,premultipliedAlpha:b.premultipliedAlpha,doubleSided:b.side===ri,flipSided:b.side===yn,useDepthPacking:b.depthPacking>=0,depthPacking:b.depthPacking||0,index0AttributeName:b.index0AttributeName,extensionClipCullDistance:ot&&b.extensions.clipCullDistance===!0&&t.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(ot&&b.extensions.multiDraw===!0||Gt)&&t.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:t.has("KHR_parallel_shader_compile"),customProgramCacheKey:b.customProgramCacheKey()};return lt.vertexUv1s=d.has(1),lt.vertexUv2s=d.has(2),lt.vertexUv3s=d.has(3),d.clear(),lt}function R(b){let L=[];if(b.shaderID?L.push(b.shaderID):(L.push(b.customVertexShaderID),L.push(b.customFragmentShaderID)),b.defines!==void 0)for(let q in b.defines)L.push(q),L.push(b.defines[q]);return b.isRawShaderMaterial===!1&&(x(L,b),y(L,b),L.push(i.outputColorSpace)),L.push(b.customProgramCacheKey),L.join()}function x(b,L){b.push(L.precision),b.push(L.outputColorSpace),b.push(L.envMapMode),b.push(L.envMapPMREM),b.push(L.envMapMaxLod),b.push(L.envMapSize),b.push(L.mapUv),b.push(L.alphaMapUv),b.push(L.lightMapUv),b.push(L.aoMapUv),b.push(L.bumpMapUv),b.push(L.normalMapUv),b.push(L.displacementMapUv),b.push(L.emissiveMapUv),b.push(L.metalnessMapUv),b.push(L.roughnessMapUv),b.push(L.anisotropyMapUv),b.push(L.clearcoatMapUv),b.push(L.clearcoatNormalMapUv),b.push(L.clearcoatRoughnessMapUv),b.push(L.diffuseRoughnessMapUv),b.push(L.iridescenceMapUv),b.push(L.iridescenceThicknessMapUv),b.push(L.sheenColorMapUv),b.push(L.sheenRoughnessMapUv),b.push(L.specularMapUv),b.push(L.specularColorMapUv),b.push(L.specularIntensityMapUv),b.push(L.transmissionMapUv),b.push(L.thicknessMapUv),b.push(L.combine),b.push(L.fogExp2),b.push(L.sizeAttenuation),b.push(L.morphTargetsCount),b.push(L.numSunLights),b.push(L.numDirLights),b.push(L.numPointLights),b.push(L.numSpotLights),b.push(L.numSpotLightMaps),b.push(L.numHemiLights),b.push(L.numRectAreaLights),b.push(L.numSunLightShadows),b.push(L.numDirLightShadows),b.push(L.numPointLightShadows),b.push(L.numSpotLightShadows),b.push(L.numSpotLightShadowsWithMaps),b.push(L.numLightProbes),b.push(L.numLightProbeGrids),b.push(L.shadowMapType),b.push(L.toneMapping),b.push(L.numClippingPlanes),b.push(L.numClipIntersection),b.push(L.depthPacking)}function y(b,L){c.disableAll(),L.instancing&&c.enable(0),L.instancingColor&&c.enable(1),L.instancingMorph&&c.enable(2),L.matcap&&c.enable(3),L.envMap&&c.enable(4),L.normalMapObjectSpace&&c.enable(5),L.normalMapTangentSpace&&c.enable(6),L.clearcoat&&c.enable(7),L.iridescence&&c.enable(8),L.alphaTest&&c.enable(9),L.vertexColors&&c.enable(10),L.vertexAlphas&&c.enable(11),L.vertexUv1s&&c.enable(12),L.vertexUv2s&&c.enable(13),L.vertexUv3s&&c.enable(14),L.vertexTangents&&c.enable(15),L.anisotropy&&c.enable(16),L.alphaHash&&c.enable(17),L.batching&&c.enable(18),L.dispersion&&c.enable(19),L.retroreflection&&c.enable(24),L.diffuseRoughness&&c.enable(25),L.batchingColor&&c.enable(20),L.gradientMap&&c.enable(21),L.packedNormalMap&&c.enable(22),L.vertexNormals&&c.enable(23),b.push(c.mask),c.disableAll(),L.fog&&c.enable(0),L.useFog&&c.enable(1),L.flatShading&&c.enable(2),L.logarithmicDepthBuffer&&c.enable(3),L.reversedDepthBuffer&&c.enable(4),L.skinning&&c.enable(5),L.morphTargets&&c.enable(6),L.morphNormals&&c.enable(7),L.morphColors&&c.enable(8),L.premultipliedAlpha&&c.enable(9),L.shadowMapEnabled&&c.enable(10),L.doubleSided&&c.enable(11),L.flipSided&&c.enable(12),L.useDepthPacking&&c.enable(13),L.dithering&&c.enable(14),L.transmission&&c.enable(15),L.sheen&&c.enable(16),L.opaque&&c.enable(17),L.pointsUvs&&c.enable(18),L.decodeVideoTexture&&c.enable(19),L.decodeVideoTextureEmissive&&c.enable(20),L.alphaToCoverage&&c.enable(21),L.numLightProbeGrids>0&&c.enable(22),L.hasPositionAttribute&&c.enable(23),b.push(c.mask)}function P(b){let L=g[b.type],q;if(L){let k=oi[L];q=ud.clone(k.uniforms)}else q=b.uniforms;return q}function U(b,L){let q=p.get(L);return q!==void 0?++q.usedTimes:(q=new SM(i,L,b,s),f.push(q),p.set(L,q)),q}function I(b){if(--b.usedTimes===0){let L=f.indexOf(b);f[L]=f[f.length-1],f.pop(),p.delete(b.cacheKey),b.destroy()}}function O(b){h.remove(b)}function N(){h.dispose()}return{getParameters:w,getProgramCacheKey:R,getUniforms:P,acquireProgram:U,releaseProgram:I,releaseShaderCache:O,programs:f,dispose:N}}function EM(){let i=new WeakMap;function e(c){return i.has(c)}function t(c){let h=i.get(c);return h===void 0&&(h={},i.set(c,h)),h}function n(c){i.delete(c)}function s(c,h,d){i.get(c)[h]=d}function o(){i=new WeakMap}return{has:e,get:t,remove:n,update:s,dispose:o}}function TM(i,e){return i.groupOrder!==e.groupOrder?i.groupOrder-e.groupOrder:i.renderOrder!==e.renderOrder?i.renderOrder-e.renderOrder:i.material.id!==e.material.id?i.material.id-e.material.id:i.materialVariant!==e.materialVariant?i.materialVariant-e.materialVariant:i.z!==e.z?i.z-e.z:i.id-e.id}function Id(i,e){return i.groupOrder!==e.groupOrder?i.groupOrder-e.groupOrder:i.renderOrder!==e.renderOrder?i.renderOrder-e.renderOrder:i.z!==e.z?e.z-i.z:i.id-e.id}function Ld(){let i=[],e=0,t=[],n=[],s=[];function o(){e=0,t.length=0,n.length=0,s.length=0}function c(g){let S=0;return g.isInstancedMesh&&(S+=2),g.isSkinnedMesh&&(S+=1),S}function h(g,S,w,R,x,y){let P=i[e];return P===void 0?(P={id:g.id,object:g,geometry:S,material:w,materialVariant:c(g),groupOrder:R,renderOrder:g.renderOrder,z:x,group:y},i[e]=P):(P.id=g.id,P.object=g,P.geometry=S,P.material=w,P.materialVariant=c(g),P.groupOrder=R,P.renderOrder=g.renderOrder,P.z=x,P.group=y),e++,P}function d(g,S,w,R,x,y,P){P.reversedDepth===!0&&(x=-x);let U=h(g,S,w,R,x,y);w.transmission>0?n.push(U):w.transparent===!0?s.push(U):t.push(U)}function f(g,S,w,R,x,y){let P=h(g,S,w,R,x,y);w.transmission>0?n.unshift(P):w.transparent===!0?s.unshift(P):t.unshift(P)}function p(g,S){t.length>1&&t.sort(g||TM),n.length>1&&n.sort(S||Id),s.length>1&&s.sort(S||Id)}function _(){for(let g=e,S=i.length;g<S;g++){let w=i[g];if(w.id===null)break;w.id=null,w.object=null,w.geometry=null,w.material=null,w.group=null}}return{opaque:t,transmissive:n,transparent:s,init:o,push:d,unshift:f,finish:_,sort:p}}function AM(){let i=new WeakMap;function e(n,s){let o=i.get(n),c;return o===void 0?(c=new Ld,i.set(n,[c])):s>=o.length?(c=new Ld,o.push(c)):c=o[s],c}function t(){i=new WeakMap}return{get:e,dispose:t}}function CM(){let i={};return{get:function(e){if(i[e.id]!==void 0)return i[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={direction:new Q,color:new ut};break;case"SpotLight":t={position:new Q,direction:new Q,color:new ut,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":t={position:new Q,color:new ut,distance:0,decay:0};break;case"HemisphereLight":t={direction:new Q,skyColor:new ut,groundColor:new ut};break;case"RectAreaLight":t={color:new ut,position:new Q,halfWidth:new Q,halfHeight:new Q};break}return i[e.id]=t,t}}}function RM(){let i={};return{get:function(e){if(i[e.id]!==void 0)return i[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new gt};break;case"SpotLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new gt};break;case"PointLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new gt,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[e.id]=t,t}}}var PM=0;function IM(i,e){return(e.castShadow?2:0)-(i.castShadow?2:0)+(e.map?1:0)-(i.map?1:0)}function LM(i){let e=new CM,t=RM(),n={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let f=0;f<9;f++)n.probe.push(new Q);let s=new Q,o=new It,c=new It;function h(f){let p=0,_=0,g=0;for(let J=0;J<9;J++)n.probe[J].set(0,0,0);let S=0,w=0,R=0,x=0,y=0,P=0,U=0,I=0,O=0,N=0,b=0,L=0,q=0,k=0;f.sort(IM);for(let J=0,ee=f.length;J<ee;J++){let z=f[J],ie=z.color,G=z.intensity,ne=z.distance,Se=null;if(z.shadow&&z.shadow.map&&(z.shadow.map.texture.format===Bi?Se=z.shadow.map.texture:Se=z.shadow.map.depthTexture||z.shadow.map.texture),z.isAmbientLight)p+=ie.r*G,_+=ie.g*G,g+=ie.b*G;else if(z.isLightProbe){for(let re=0;re<9;re++)n.probe[re].addScaledVector(z.sh.coefficients[re],G);k++}else if(z.isSunLight){let re=e.get(z);if(re.color.copy(z.color).multiplyScalar(z.intensity),z.castShadow){let H=z.shadow,me=t.get(z);me.shadowIntensity=H.intensity,me.shadowBias=H.bias,me.shadowNormalBias=H.normalBias,me.shadowRadius=H.radius,me.shadowMapSize.copy(H.mapSize).multiply(H.getFrameExtents()),n.sunShadow[w]=me,n.sunShadowMap[w]=Se;let Xe=H.getViewportCount();for(let nt=0;nt<Xe;nt++)n.sunShadowMatrix[R+nt]=H.getMatrix(nt),n.sunShadowCascade[R+nt]=H._cascadeData[nt];R+=Xe,w++}n.sun[S]=re,S++}else if(z.isDirectionalLight){let re=e.get(z);if(re.color.copy(z.color).multiplyScalar(z.intensity),z.castShadow){let H=z.shadow,me=t.get(z);me.shadowIntensity=H.intensity,me.shadowBias=H.bias,me.shadowNormalBias=H.normalBias,me.shadowRadius=H.radius,me.shadowMapSize=H.mapSize,n.directionalShadow[x]=me,n.directionalShadowMap[x]=Se,n.directionalShadowMatrix[x]=z.shadow.matrix,O++}n.directional[x]=re,x++}else if(z.isSpotLight){let re=e.get(z);re.position.setFromMatrixPosition(z.matrixWorld),re.color.copy(ie).multiplyScalar(G),re.distance=ne,re.coneCos=Math.cos(z.angle),re.penumbraCos=Math.cos(z.angle*(1-z.penumbra)),re.decay=z.decay,n.spot[P]=re;let H=z.shadow;if(z.map&&(n.spotLightMap[L]=z.map,L++,H.updateMatrices(z),z.castShadow&&q++),n.spotLightMatrix[P]=H.matrix,z.castShadow){let me=t.get(z);me.shadowIntensity=H.intensity,me.shadowBias=H.bias,me.shadowNormalBias=H.normalBias,me.shadowRadius=H.radius,me.shadowMapSize=H.mapSize,n.spotShadow[P]=me,n.spotShadowMap[P]=Se,b++}P++}else if(z.isRectAreaLight){let re=e.get(z);re.color.copy(ie).multiplyScalar(G),re.halfWidth.set(z.width*.5,0,0),re.halfHeight.set(0,z.height*.5,0),n.rectArea[U]=re,U++}else if(z.isPointLight){let re=e.get(z);if(re.color.copy(z.color).multiplyScalar(z.intensity),re.distance=z.distance,re.decay=z.decay,z.castShadow){let H=z.shadow,me=t.get(z);me.shadowIntensity=H.intensity,me.shadowBias=H.bias,me.shadowNormalBias=H.normalBias,me.shadowRadius=H.radius,me.shadowMapSize=H.mapSize,me.shadowCameraNear=H.camera.near,me.shadowCameraFar=H.camera.far,n.pointShadow[y]=me,n.pointShadowMap[y]=Se,n.pointShadowMatrix[y]=z.shadow.matrix,N++}n.point[y]=re,y++}else if(z.isHemisphereLight){let re=e.get(z);re.skyColor.copy(z.color).multiplyScalar(G),re.groundColor.copy(z.groundColor).multiplyScalar(G),n.hemi[I]=re,I++}}U>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=Be.LTC_FLOAT_1,n.rectAreaLTC2=Be.LTC_FLOAT_2):(n.rectAreaLTC1=Be.LTC_HALF_1,n.rectAreaLTC2=Be.LTC_HALF_2)),n.ambient[0]=p,n.ambient[1]=_,n.ambient[2]=g;let Y=n.hash;(Y.sunLength!==S||Y.directionalLength!==x||Y.pointLength!==y||Y.spotLength!==P||Y.rectAreaLength!==U||Y.hemiLength!==I||Y.numSunShadows!==w||Y.numDirectionalShadows!==O||Y.numPointShadows!==N||Y.numSpotShadows!==b||Y.numSpotMaps!==L||Y.numLightProbes!==k)&&(n.sun.length=S,n.directional.length=x,n.spot.length=P,n.rectArea.length=U,n.point.length=y,n.hemi.length=I,n.sunShadow.length=w,n.sunShadowMap.length=w,n.sunShadowMatrix.length=R,n.sunShadowCascade.length=R,n.directionalShadow.length=O,n.directionalShadowMap.length=O,n.directionalShadowMatrix.length=O,n.pointShadow.length=N,n.pointShadowMap.length=N,n.pointShadowMatrix.length=N,n.spotShadow.length=b,n.spotShadowMap.length=b,n.spotLightMatrix.length=b+L-q,n.spotLightMap.length=L,n.numSpotLightShadowsWithMaps=q,n.numLightProbes=k,Y.sunLength=S,Y.directionalLength=x,Y.pointLength=y,Y.spotLength=P,Y.rectAreaLength=U,Y.hemiLength=I,Y.numSunShadows=w,Y.numDirectionalShadows=O,Y.numPointShadows=N,Y.numSpotShadows=b,Y.numSpotMaps=L,Y.numLightProbes=k,n.version=PM++)}function d(f,p){let _=0,g=0,S=0,w=0,R=0,x=0,y=p.matrixWorldInverse;for(let P=0,U=f.length;P<U;P++){let I=f[P];if(I.isSunLight){let O=n.sun[_];O.direction.setFromMatrixPosition(I.matrixWorld),O.direction.transformDirection(y),_++}else if(I.isDirectionalLight){let O=n.directional[g];O.direction.setFromMatrixPosition(I.matrixWorld),s.setFromMatrixPosition(I.target.matrixWorld),O.direction.sub(s),O.direction.transformDirection(y),g++}else if(I.isSpotLight){let O=n.spot[w];O.position.setFromMatrixPosition(I.matrixWorld),O.position.applyMatrix4(y),O.direction.setFromMatrixPosition(I.matrixWorld),s.setFromMatrixPosition(I.target.matrixWorld),O.direction.sub(s),O.direction.transformDirection(y),w++}else if(I.isRectAreaLight){let O=n.rectArea[R];O.position.setFromMatrixPosition(I.matrixWorld),O.position.applyMatrix4(y),c.identity(),o.copy(I.matrixWorld),o.premultiply(y),c.extractRotation(o),O.halfWidth.set(I.width*.5,0,0),O.halfHeight.set(0,I.height*.5,0),O.halfWidth.applyMatrix4(c),O.halfHeight.applyMatrix4(c),R++}else if(I.isPointLight){let O=n.point[S];O.position.setFromMatrixPosition(I.matrixWorld),O.position.applyMatrix4(y),S++}else if(I.isHemisphereLight){let O=n.hemi[x];O.direction.setFromMatrixPosition(I.matrixWorld),O.direction.transformDirection(y),x++}}}return{setup:h,setupView:d,state:n}}function Dd(i){let e=new LM(i),t=[],n=[],s=[];function o(_){p.camera=_,t.length=0,n.length=0,s.length=0}function c(_){_.isLightProbeGrid?s.push(_):t.push(_)}function h(_){n.push(_)}function d(){e.setup(t),s.sort((_,g)=>_.priority-g.priority||_.id-g.id)}function f(_){e.setupView(t,_)}let p={lightsArray:t,shadowsArray:n,lightProbeGridArray:s,camera:null,lights:e,transmissionRenderTarget:{},textureUnits:0};return{init:o,state:p,setupLights:d,setupLightsView:f,pushLight:c,pushShadow:h}}function DM(i){let e=new WeakMap;function t(s,o=0){let c=e.get(s),h;return c===void 0?(h=new Dd(i),e.set(s,[h])):o>=c.length?(h=new Dd(i),c.push(h)):h=c[o],h}function n(){e=new WeakMap}return{get:t,dispose:n}}var FM=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,NM=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,UM=[new Q(1,0,0),new Q(-1,0,0),new Q(0,1,0),new Q(0,-1,0),new Q(0,0,1),new Q(0,0,-1)],OM=[new Q(0,-1,0),new Q(0,-1,0),new Q(0,0,1),new Q(0,0,-1),new Q(0,-1,0),new Q(0,-1,0)],Fd=new It,Bs=new Q,Vc=new Q;function BM(i,e,t){let n=new Li,s=new gt,o=new gt,c=new zt,h=new eo,d=new to,f={},p=t.maxTextureSize,_={[Oi]:yn,[yn]:Oi,[ri]:ri},g=new ii({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new gt},radius:{value:4}},vertexShader:FM,fragmentShader:NM}),S=g.clone();S.defines.HORIZONTAL_PASS=1;let w=new vn;w.setAttribute("position",new ei(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let R=new Ln(w,g),x=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=nr;let y=this.type;this.render=function(N,b,L){if(x.enabled===!1||x.autoUpdate===!1&&x.needsUpdate===!1||N.length===0)return;this.type===Au&&(Qe("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=nr);let q=i.getRenderTarget(),k=i.getActiveCubeFace(),Y=i.getActiveMipmapLevel(),J=i.state;J.setBlending(ir),J.buffers.depth.getReversed()===!0?J.buffers.color.setClear(0,0,0,0):J.buffers.color.setClear(1,1,1,1),J.buffers.depth.setTest(!0),J.setScissorTest(!1);let ee=y!==this.type;ee&&b.traverse(function(z){z.material&&(Array.isArray(z.material)?z.material.forEach(ie=>ie.needsUpdate=!0):z.material.needsUpdate=!0)});for(let z=0,ie=N.length;z<ie;z++){let G=N[z],ne=G.shadow;if(ne===void 0){Qe("WebGLShadowMap:",G,"has no shadow.");continue}if(ne.autoUpdate===!1&&ne.needsUpdate===!1)continue;s.copy(ne.mapSize);let Se=ne.getFrameExtents();s.multiply(Se),o.copy(ne.mapSize),(s.x>p||s.y>p)&&(s.x>p&&(o.x=Math.floor(p/Se.x),s.x=o.x*Se.x,ne.mapSize.x=o.x),s.y>p&&(o.y=Math.floor(p/Se.y),s.y=o.y*Se.y,ne.mapSize.y=o.y));let re=i.state.buffers.depth.getReversed();if(ne.camera._reversedDepth=re,ne.map===null||ee===!0){if(ne.map!==null&&(ne.map.depthTexture!==null&&(ne.map.depthTexture.dispose(),ne.map.depthTexture=null),ne.map.dispose()),this.type===zr){if(G.isPointLight){Qe("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}ne.map=new En(s.x,s.y,{format:Bi,type:Vn,minFilter:_n,magFilter:_n,generateMipmaps:!1}),ne.map.texture.name=G.name+".shadowMap",ne.map.depthTexture=new yi(s.x,s.y,Gn),ne.map.depthTexture.name=G.name+".shadowMapDepth",ne.map.depthTexture.format=gi,ne.map.depthTexture.compareFunction=null,ne.map.depthTexture.minFilter=sn,ne.map.depthTexture.magFilter=sn}else G.isPointLight?(ne.map=new zs(s.x),ne.map.depthTexture=new ys(s.x,zn)):(ne.map=new En(s.x,s.y),ne.map.depthTexture=new yi(s.x,s.y,zn)),ne.map.depthTexture.name=G.name+".shadowMap",ne.map.depthTexture.format=gi,this.type===nr?(ne.map.depthTexture.compareFunction=re?Pc:Rc,ne.map.depthTexture.minFilter=_n,ne.map.depthTexture.magFilter=_n):(ne.map.depthTexture.compareFunction=null,ne.map.depthTexture.minFilter=sn,ne.map.depthTexture.magFilter=sn);ne.camera.updateProjectionMatrix()}ne.map.isWebGLCubeRenderTarget!==!0&&(ne.map.width!==s.x||ne.map.height!==s.y)&&ne.map.setSize(s.x,s.y);let H=ne.map.isWebGLCubeRenderTarget?6:ne.getViewportCount();G.isPointLight!==!0&&ne.updateMatrices(G,L);let me=(ne.camera.layers.mask&4294967294)!==0?ne.camera.layers:L.layers;for(let Xe=0;Xe<H;Xe++){let nt=ne.getCamera(Xe);if(G.isPointLight){let ue=ne.camera,Fe=ne.matrix,Pe=G.distance||ue.far;Pe!==ue.far&&(ue.far=Pe,ue.updateProjectionMatrix()),Bs.setFromMatrixPosition(G.matrixWorld),ue.position.copy(Bs),Vc.copy(ue.position),Vc.add(UM[Xe]),ue.up.copy(OM[Xe]),ue.lookAt(Vc),ue.updateMatrixWorld(),Fe.makeTranslation(-Bs.x,-Bs.y,-Bs.z),Fd.multiplyMatrices(ue.projectionMatrix,ue.matrixWorldInverse),ne._frustum.setFromProjectionMatrix(Fd,ue.coordinateSystem,ue.reversedDepth)}if(ne.map.isWebGLCubeRenderTarget)i.setRenderTarget(ne.map,Xe),i.clear();else{Xe===0&&(i.setRenderTarget(ne.map),i.clear());let ue=ne.getViewport(Xe);c.set(o.x*ue.x,o.y*ue.y,o.x*ue.z,o.y*ue.w),J.viewport(c)}n=ne.getFrustum(Xe),I(b,L,nt,G,me,this.type)}ne.isPointLightShadow!==!0&&this.type===zr&&P(ne,L),ne.needsUpdate=!1}y=this.type,x.needsUpdate=!1,i.setRenderTarget(q,k,Y)};function P(N,b){let L=e.update(R);g.defines.VSM_SAMPLES!==N.blurSamples&&(g.defines.VSM_SAMPLES=N.blurSamples,S.defines.VSM_SAMPLES=N.blurSamples,g.needsUpdate=!0,S.needsUpdate=!0),N.mapPass===null?N.mapPass=new En(s.x,s.y,{format:Bi,type:Vn}):(N.mapPass.width!==N.map.width||N.mapPass.height!==N.map.height)&&N.mapPass.setSize(N.map.width,N.map.height),g.uniforms.shadow_pass.value=N.map.depthTexture,g.uniforms.resolution.value.set(N.map.width,N.map.height),g.uniforms.radius.value=N.radius,i.setRenderTarget(N.mapPass),i.clear(),i.renderBufferDirect(b,null,L,g,R,null),S.uniforms.shadow_pass.value=N.mapPass.texture,S.uniforms.resolution.value.set(N.map.width,N.map.height),S.uniforms.radius.value=N.radius,i.setRenderTarget(N.map),i.clear(),i.renderBufferDirect(b,null,L,S,R,null)}function U(N,b,L,q){let k=null,Y=L.isPointLight===!0?N.customDistanceMaterial:N.customDepthMaterial;if(Y!==void 0)k=Y;else if(k=L.isPointLight===!0?d:h,i.localClippingEnabled&&b.clipShadows===!0&&Array.isArray(b.clippingPlanes)&&b.clippingPlanes.length!==0||b.displacementMap&&b.displacementScale!==0||b.alphaMap&&b.alphaTest>0||b.map&&b.alphaTest>0||b.alphaToCoverage===!0){let J=k.uuid,ee=b.uuid,z=f[J];z===void 0&&(z={},f[J]=z);let ie=z[ee];ie===void 0&&(ie=k.clone(),z[ee]=ie,b.addEventListener("dispose",O)),k=ie}if(k.visible=b.visible,k.wireframe=b.wireframe,q===zr?k.side=b.shadowSide!==null?b.shadowSide:b.side:k.side=b.shadowSide!==null?b.shadowSide:_[b.side],k.alphaMap=b.alphaMap,k.alphaTest=b.alphaToCoverage===!0?.5:b.alphaTest,k.map=b.map,k.clipShadows=b.clipShadows,k.clippingPlanes=b.clippingPlanes,k.clipIntersection=b.clipIntersection,k.displacementMap=b.displacementMap,k.displacementScale=b.displacementScale,k.displacementBias=b.displacementBias,k.wireframeLinewidth=b.wireframeLinewidth,k.linewidth=b.linewidth,L.isPointLight===!0&&k.isMeshDistanceMaterial===!0){let J=i.properties.get(k);J.light=L}return k}function I(N,b,L,q,k,Y){if(N.visible===!1)return;if(N.layers.test(k)&&(N.isMesh||N.isLine||N.isPoints)&&(N.castShadow||N.receiveShadow&&Y===zr)&&(!N.frustumCulled||N.intersectsFrustum(n))){N.modelViewMatrix.multiplyMatrices(L.matrixWorldInverse,N.matrixWorld);let z=e.update(N),ie=N.material;if(Array.isArray(ie)){let G=z.groups;for(let ne=0,Se=G.length;ne<Se;ne++){let re=G[ne],H=ie[re.materialIndex];if(H&&H.visible){let me=U(N,H,q,Y);N.onBeforeShadow(i,N,b,L,z,me,re),i.renderBufferDirect(L,null,z,me,N,re),N.onAfterShadow(i,N,b,L,z,me,re)}}}else if(ie.visible){let G=U(N,ie,q,Y);N.onBeforeShadow(i,N,b,L,z,G,null),i.renderBufferDirect(L,null,z,G,N,null),N.onAfterShadow(i,N,b,L,z,G,null)}}let ee=N.children;for(let z=0,ie=ee.length;z<ie;z++)I(ee[z],b,L,q,k,Y)}function O(N){N.target.removeEventListener("dispose",O);for(let L in f){let q=f[L],k=N.target.uuid;k in q&&(q[k].dispose(),delete q[k])}}}function kM(i,e){function t(){let B=!1,he=new zt,se=null,Re=new zt(0,0,0,0);return{setMask:function(Ee){se!==Ee&&!B&&(i.colorMask(Ee,Ee,Ee,Ee),se=Ee)},setLocked:function(Ee){B=Ee},setClear:function(Ee,Ae,$e,ot,we){we===!0&&(Ee*=ot,Ae*=ot,$e*=ot),he.set(Ee,Ae,$e,ot),Re.equals(he)===!1&&(i.clearColor(Ee,Ae,$e,ot),Re.copy(he))},reset:function(){B=!1,se=null,Re.set(-1,0,0,0)}}}function n(){let B=!1,he=!1,se=null,Re=null,Ee=null;return{setReversed:function(Ae){if(he!==Ae){let $e=e.get("EXT_clip_control");Ae?$e.clipControlEXT($e.LOWER_LEFT_EXT,$e.ZERO_TO_ONE_EXT):$e.clipControlEXT($e.LOWER_LEFT_EXT,$e.NEGATIVE_ONE_TO_ONE_EXT),he=Ae;let ot=Ee;Ee=null,this.setClear(ot)}},getReversed:function(){return he},setTest:function(Ae){Ae?Ue(i.DEPTH_TEST):rt(i.DEPTH_TEST)},setMask:function(Ae){se!==Ae&&!B&&(i.depthMask(Ae),se=Ae)},setFunc:function(Ae){if(he&&(Ae=od[Ae]),Re!==Ae){switch(Ae){case Na:i.depthFunc(i.NEVER);break;case Ua:i.depthFunc(i.ALWAYS);break;case Oa:i.depthFunc(i.LESS);break;case Cr:i.depthFunc(i.LEQUAL);break;case Ba:i.depthFunc(i.EQUAL);break;case ka:i.depthFunc(i.GEQUAL);break;case za:i.depthFunc(i.GREATER);break;case Ga:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}Re=Ae}},setLocked:function(Ae){B=Ae},setClear:function(Ae){Ee!==Ae&&(Ee=Ae,he&&(Ae=1-Ae),i.clearDepth(Ae))},reset:function(){B=!1,se=null,Re=null,Ee=null,he=!1}}}function s(){let B=!1,he=null,se=null,Re=null,Ee=null,Ae=null,$e=null,ot=null,we=null;return{setTest:function(Ye){B||(Ye?Ue(i.STENCIL_TEST):rt(i.STENCIL_TEST))},setMask:function(Ye){he!==Ye&&!B&&(i.stencilMask(Ye),he=Ye)},setFunc:function(Ye,lt,Oe){(se!==Ye||Re!==lt||Ee!==Oe)&&(i.stencilFunc(Ye,lt,Oe),se=Ye,Re=lt,Ee=Oe)},setOp:function(Ye,lt,Oe){(Ae!==Ye||$e!==lt||ot!==Oe)&&(i.stencilOp(Ye,lt,Oe),Ae=Ye,$e=lt,ot=Oe)},setLocked:function(Ye){B=Ye},setClear:function(Ye){we!==Ye&&(i.clearStencil(Ye),we=Ye)},reset:function(){B=!1,he=null,se=null,Re=null,Ee=null,Ae=null,$e=null,ot=null,we=null}}}let o=new t,c=new n,h=new s,d={},f=new WeakMap,p={},_={},g={},S=new WeakMap,w=[],R=null,x=!1,y=null,P=null,U=null,I=null,O=null,N=null,b=null,L=new ut(0,0,0),q=0,k=!1,Y=null,J=null,ee=null,z=null,ie=null,G=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS),ne=!1,Se=0,re=i.getParameter(i.VERSION);re.indexOf("WebGL")!==-1?(Se=parseFloat(/^WebGL (\d)/.exec(re)[1]),ne=Se>=1):re.indexOf("OpenGL ES")!==-1&&(Se=parseFloat(/^OpenGL ES (\d)/.exec(re)[1]),ne=Se>=2);let H=null,me={},Xe=i.getParameter(i.SCISSOR_BOX),nt=i.getParameter(i.VIEWPORT),ue=new zt().fromArray(Xe),Fe=new zt().fromArray(nt);function Pe(B,he,se,Re){let Ee=new Uint8Array(4),Ae=i.createTexture();i.bindTexture(B,Ae),i.texParameteri(B,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(B,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let $e=0;$e<se;$e++)B===i.TEXTURE_3D||B===i.TEXTURE_2D_ARRAY?i.texImage3D(he,0,i.RGBA,1,1,Re,0,i.RGBA,i.UNSIGNED_BYTE,Ee):i.texImage2D(he+$e,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,Ee);return Ae}let je={};je[i.TEXTURE_2D]=Pe(i.TEXTURE_2D,i.TEXTURE_2D,1),je[i.TEXTURE_CUBE_MAP]=Pe(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),je[i.TEXTURE_2D_ARRAY]=Pe(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),je[i.TEXTURE_3D]=Pe(i.TEXTURE_3D,i.TEXTURE_3D,1,1),o.setClear(0,0,0,1),c.setClear(1),h.setClear(0),Ue(i.DEPTH_TEST),c.setFunc(Cr),Rt(!1),St(oc),Ue(i.CULL_FACE),Vt(ir);function Ue(B){p[B]!==!0&&(i.enable(B),p[B]=!0)}function rt(B){p[B]!==!1&&(i.disable(B),p[B]=!1)}function Gt(B,he){return g[B]!==he?(i.bindFramebuffer(B,he),g[B]=he,B===i.DRAW_FRAMEBUFFER&&(g[i.FRAMEBUFFER]=he),B===i.FRAMEBUFFER&&(g[i.DRAW_FRAMEBUFFER]=he),!0):!1}function et(B,he){let se=w,Re=!1;if(B){se=S.get(he),se===void 0&&(se=[],S.set(he,se));let Ee=B.textures;if(se.length!==Ee.length||se[0]!==i.COLOR_ATTACHMENT0){for(let Ae=0,$e=Ee.length;Ae<$e;Ae++)se[Ae]=i.COLOR_ATTACHMENT0+Ae;se.length=Ee.length,Re=!0}}else se[0]!==i.BACK&&(se[0]=i.BACK,Re=!0);Re&&i.drawBuffers(se)}function wt(B){return R!==B?(i.useProgram(B),R=B,!0):!1}let Tt={[rr]:i.FUNC_ADD,[Ru]:i.FUNC_SUBTRACT,[Pu]:i.FUNC_REVERSE_SUBTRACT};Tt[Iu]=i.MIN,Tt[Lu]=i.MAX;let dt={[Du]:i.ZERO,[Fu]:i.ONE,[Nu]:i.SRC_COLOR,[uc]:i.SRC_ALPHA,[Gu]:i.SRC_ALPHA_SATURATE,[ku]:i.DST_COLOR,[Ou]:i.DST_ALPHA,[Uu]:i.ONE_MINUS_SRC_COLOR,[dc]:i.ONE_MINUS_SRC_ALPHA,[zu]:i.ONE_MINUS_DST_COLOR,[Bu]:i.ONE_MINUS_DST_ALPHA,[Vu]:i.CONSTANT_COLOR,[Hu]:i.ONE_MINUS_CONSTANT_COLOR,[Wu]:i.CONSTANT_ALPHA,[Xu]:i.ONE_MINUS_CONSTANT_ALPHA};function Vt(B,he,se,Re,Ee,Ae,$e,ot,we,Ye){if(B===ir){x===!0&&(rt(i.BLEND),x=!1);return}if(x===!1&&(Ue(i.BLEND),x=!0),B!==Cu){if(B!==y||Ye!==k){if((P!==rr||O!==rr)&&(i.blendEquation(i.FUNC_ADD),P=rr,O=rr),Ye)switch(B){case Gr:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case lc:i.blendFunc(i.ONE,i.ONE);break;case cc:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case hc:i.blendFuncSeparate(i.DST_COLOR,i.ONE_MINUS_SRC_ALPHA,i.ZERO,i.ONE);break;default:tt("WebGLState: Invalid blending: ",B);break}else switch(B){case Gr:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case lc:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE,i.ONE,i.ONE);break;case cc:tt("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case hc:tt("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:tt("WebGLState: Invalid blending: ",B);break}U=null,I=null,N=null,b=null,L.set(0,0,0),q=0,y=B,k=Ye}return}Ee=Ee||he,Ae=Ae||se,$e=$e||Re,(he!==P||Ee!==O)&&(i.blendEquationSeparate(Tt[he],Tt[Ee]),P=he,O=Ee),(se!==U||Re!==I||Ae!==N||$e!==b)&&(i.blendFuncSeparate(dt[se],dt[Re],dt[Ae],dt[$e]),U=se,I=Re,N=Ae,b=$e),(ot.equals(L)===!1||we!==q)&&(i.blendColor(ot.r,ot.g,ot.b,we),L.copy(ot),q=we),y=B,k=!1}function ht(B,he){B.side===ri?rt(i.CULL_FACE):Ue(i.CULL_FACE);let se=B.side===yn;he&&(se=!se),Rt(se),B.blending===Gr&&B.transparent===!1?Vt(ir):Vt(B.blending,B.blendEquation,B.blendSrc,B.blendDst,B.blendEquationAlpha,B.blendSrcAlpha,B.blendDstAlpha,B.blendColor,B.blendAlpha,B.premultipliedAlpha),c.setFunc(B.depthFunc),c.setTest(B.depthTest),c.setMask(B.depthWrite),o.setMask(B.colorWrite);let Re=B.stencilWrite;h.setTest(Re),Re&&(h.setMask(B.stencilWriteMask),h.setFunc(B.stencilFunc,B.stencilRef,B.stencilFuncMask),h.setOp(B.stencilFail,B.stencilZFail,B.stencilZPass)),Le(B.polygonOffset,B.polygonOffsetFactor,B.polygonOffsetUnits),B.alphaToCoverage===!0?Ue(i.SAMPLE_ALPHA_TO_COVERAGE):rt(i.SAMPLE_ALPHA_TO_COVERAGE)}function Rt(B){Y!==B&&(B?i.frontFace(i.CW):i.frontFace(i.CCW),Y=B)}function St(B){B!==Eu?(Ue(i.CULL_FACE),B!==J&&(B===oc?i.cullFace(i.BACK):B===Tu?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):rt(i.CULL_FACE),J=B}function Qt(B){B!==ee&&(ne&&i.lineWidth(B),ee=B)}function Le(B,he,se){B?(Ue(i.POLYGON_OFFSET_FILL),(z!==he||ie!==se)&&(z=he,ie=se,c.getReversed()&&(he=-he,se=-se),i.polygonOffset(he,se))):rt(i.POLYGON_OFFSET_FILL)}function qe(B){B?Ue(i.SCISSOR_TEST):rt(i.SCISSOR_TEST)}function an(B){B===void 0&&(B=i.TEXTURE0+G-1),H!==B&&(i.activeTexture(B),H=B)}function en(B,he,se){se===void 0&&(H===null?se=i.TEXTURE0+G-1:se=H);let Re=me[se];Re===void 0&&(Re={type:void 0,texture:void 0},me[se]=Re),(Re.type!==B||Re.texture!==he)&&(H!==se&&(i.activeTexture(se),H=se),i.bindTexture(B,he||je[B]),Re.type=B,Re.texture=he)}function W(){let B=me[H];B!==void 0&&B.type!==void 0&&(i.bindTexture(B.type,null),B.type=void 0,B.texture=void 0)}function fn(){try{i.compressedTexImage2D(...arguments)}catch(B){tt("WebGLState:",B)}}function At(){try{i.compressedTexImage3D(...arguments)}catch(B){tt("WebGLState:",B)}}function Nt(){try{i.texSubImage2D(...arguments)}catch(B){tt("WebGLState:",B)}}function De(){try{i.texSubImage3D(...arguments)}catch(B){tt("WebGLState:",B)}}function Xt(){try{i.compressedTexSubImage2D(...arguments)}catch(B){tt("WebGLState:",B)}}function Je(){try{i.compressedTexSubImage3D(...arguments)}catch(B){tt("WebGLState:",B)}}function Ze(){try{i.texStorage2D(...arguments)}catch(B){tt("WebGLState:",B)}}function D(){try{i.texStorage3D(...arguments)}catch(B){tt("WebGLState:",B)}}function T(){try{i.texImage2D(...arguments)}catch(B){tt("WebGLState:",B)}}function j(){try{i.texImage3D(...arguments)}catch(B){tt("WebGLState:",B)}}function ve(B){return _[B]!==void 0?_[B]:i.getParameter(B)}function de(B,he){_[B]!==he&&(i.pixelStorei(B,he),_[B]=he)}function pe(B){ue.equals(B)===!1&&(i.scissor(B.x,B.y,B.z,B.w),ue.copy(B))}function Me(B){Fe.equals(B)===!1&&(i.viewport(B.x,B.y,B.z,B.w),Fe.copy(B))}function ae(B,he){let se=f.get(he);se===void 0&&(se=new WeakMap,f.set(he,se));let Re=se.get(B);Re===void 0&&(Re=i.getUniformBlockIndex(he,B.name),i.uniformBlockBinding(he,Re,Re),se.set(B,Re))}function le(B,he,se){let Ee=f.get(he).get(B);d[Ee]!==se&&(i.bindBufferBase(i.UNIFORM_BUFFER,Ee,se),d[Ee]=se)}function Ce(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),c.setReversed(!1),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),i.pixelStorei(i.PACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,!1),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,i.BROWSER_DEFAULT_WEBGL),i.pixelStorei(i.PACK_ROW_LENGTH,0),i.pixelStorei(i.PACK_SKIP_PIXELS,0),i.pixelStorei(i.PACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_ROW_LENGTH,0),i.pixelStorei(i.UNPACK_IMAGE_HEIGHT,0),i.pixelStorei(i.UNPACK_SKIP_PIXELS,0),i.pixelStorei(i.UNPACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_SKIP_IMAGES,0),p={},_={},H=null,me={},g={},d={},S=new WeakMap,w=[],R=null,x=!1,y=null,P=null,U=null,I=null,O=null,N=null,b=null,L=new ut(0,0,0),q=0,k=!1,Y=null,J=null,ee=null,z=null,ie=null,ue.set(0,0,i.canvas.width,i.canvas.height),Fe.set(0,0,i.canvas.width,i.canvas.height),o.reset(),c.reset(),h.reset()}return{buffers:{color:o,depth:c,stencil:h},enable:Ue,disable:rt,bindFramebuffer:Gt,drawBuffers:et,useProgram:wt,setBlending:Vt,setMaterial:ht,setFlipSided:Rt,setCullFace:St,setLineWidth:Qt,setPolygonOffset:Le,setScissorTest:qe,activeTexture:an,bindTexture:en,unbindTexture:W,compressedTexImage2D:fn,compressedTexImage3D:At,texImage2D:T,texImage3D:j,pixelStorei:de,getParameter:ve,updateUBOMapping:ae,uniformBlockBinding:le,texStorage2D:Ze,texStorage3D:D,texSubImage2D:Nt,texSubImage3D:De,compressedTexSubImage2D:Xt,compressedTexSubImage3D:Je,scissor:pe,viewport:Me,reset:Ce}}function zM(i,e,t,n,s,o,c){let h=e.has("WEBGL_multisampled_render_to_texture")?e.get("WEBGL_multisampled_render_to_texture"):null,d=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),f=new gt,p=new WeakMap,_=new Set,g,S=new WeakMap,w=new Set,R=new FinalizationRegistry(D=>w.delete(D)),x=!1;try{x=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function y(D,T){return x?new OffscreenCanvas(D,T):ds("canvas")}function P(D,T,j){let ve=1,de=Ze(D);if((de.width>j||de.height>j)&&(ve=j/Math.max(de.width,de.height)),ve<1)if(typeof HTMLImageElement<"u"&&D instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&D instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&D instanceof ImageBitmap||typeof VideoFrame<"u"&&D instanceof VideoFrame){let pe=Math.floor(ve*de.width),Me=Math.floor(ve*de.height);g===void 0&&(g=y(pe,Me));let ae=T?y(pe,Me):g;return ae.width=pe,ae.height=Me,ae.getContext("2d").drawImage(D,0,0,pe,Me),Qe("WebGLRenderer: Texture has been resized from ("+de.width+"x"+de.height+") to ("+pe+"x"+Me+")."),ae}else return"data"in D&&Qe("WebGLRenderer: Image in DataTexture is too big ("+de.width+"x"+de.height+")."),D;return D}function U(D){return D.generateMipmaps}function I(D){i.generateMipmap(D)}function O(D){return D.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:D.isWebGL3DRenderTarget?i.TEXTURE_3D:D.isWebGLArrayRenderTarget||D.isCompressedArrayTexture?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D}function N(D,T,j,ve,de,pe=!1){if(D!==null){if(i[D]!==void 0)return i[D];Qe("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+D+"'")}let Me;ve&&(Me=e.get("EXT_texture_norm16"),Me||Qe("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let ae=T;if(T===i.RED&&(j===i.FLOAT&&(ae=i.R32F),j===i.HALF_FLOAT&&(ae=i.R16F),j===i.UNSIGNED_BYTE&&(ae=i.R8),j===i.UNSIGNED_SHORT&&Me&&(ae=Me.R16_EXT),j===i.SHORT&&Me&&(ae=Me.R16_SNORM_EXT)),T===i.RED_INTEGER&&(j===i.UNSIGNED_BYTE&&(ae=i.R8UI),j===i.UNSIGNED_SHORT&&(ae=i.R16UI),j===i.UNSIGNED_INT&&(ae=i.R32UI),j===i.BYTE&&(ae=i.R8I),j===i.SHORT&&(ae=i.R16I),j===i.INT&&(ae=i.R32I)),T===i.RG&&(j===i.FLOAT&&(ae=i.RG32F),j===i.HALF_FLOAT&&(ae=i.RG16F),j===i.UNSIGNED_BYTE&&(ae=i.RG8),j===i.UNSIGNED_SHORT&&Me&&(ae=Me.RG16_EXT),j===i.SHORT&&Me&&(ae=Me.RG16_SNORM_EXT)),T===i.RG_INTEGER&&(j===i.UNSIGNED_BYTE&&(ae=i.RG8UI),j===i.UNSIGNED_SHORT&&(ae=i.RG16UI),j===i.UNSIGNED_INT&&(ae=i.RG32UI),j===i.BYTE&&(ae=i.RG8I),j===i.SHORT&&(ae=i.RG16I),j===i.INT&&(ae=i.RG32I)),T===i.RGB_INTEGER&&(j===i.UNSIGNED_BYTE&&(ae=i.RGB8UI),j===i.UNSIGNED_SHORT&&(ae=i.RGB16UI),j===i.UNSIGNED_INT&&(ae=i.RGB32UI),j===i.BYTE&&(ae=i.RGB8I),j===i.SHORT&&(ae=i.RGB16I),j===i.INT&&(ae=i.RGB32I)),T===i.RGBA_INTEGER&&(j===i.UNSIGNED_BYTE&&(ae=i.RGBA8UI),j===i.UNSIGNED_SHORT&&(ae=i.RGBA16UI),j===i.UNSIGNED_INT&&(ae=i.RGBA32UI),j===i.BYTE&&(ae=i.RGBA8I),j===i.SHORT&&(ae=i.RGBA16I),j===i.INT&&(ae=i.RGBA32I)),T===i.RGB&&(j===i.UNSIGNED_SHORT&&Me&&(ae=Me.RGB16_EXT),j===i.SHORT&&Me&&(ae=Me.RGB16_SNORM_EXT),j===i.UNSIGNED_INT_5_9_9_9_REV&&(ae=i.RGB9_E5),j===i.UNSIGNED_INT_10F_11F_11F_REV&&(ae=i.R11F_G11F_B10F)),T===i.RGBA){let le=pe?us:yt.getTransfer(de);j===i.FLOAT&&(ae=i.RGBA32F),j===i.HALF_FLOAT&&(ae=i.RGBA16F),j===i.UNSIGNED_BYTE&&(ae=le===Ct?i.SRGB8_ALPHA8:i.RGBA8),j===i.UNSIGNED_SHORT&&Me&&(ae=Me.RGBA16_EXT),j===i.SHORT&&Me&&(ae=Me.RGBA16_SNORM_EXT),j===i.UNSIGNED_SHORT_4_4_4_4&&(ae=i.RGBA4),j===i.UNSIGNED_SHORT_5_5_5_1&&(ae=i.RGB5_A1)}return(ae===i.R16F||ae===i.R32F||ae===i.RG16F||ae===i.RG32F||ae===i.RGBA16F||ae===i.RGBA32F)&&e.get("EXT_color_buffer_float"),ae}function b(D,T){let j;return D?T===null||T===zn||T===ar?j=i.DEPTH24_STENCIL8:T===Gn?j=i.DEPTH32F_STENCIL8:T===Hr&&(j=i.DEPTH24_STENCIL8,Qe("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):T===null||T===zn||T===ar?j=i.DEPTH_COMPONENT24:T===Gn?j=i.DEPTH_COMPONENT32F:T===Hr&&(j=i.DEPTH_COMPONENT16),j}function L(D,T){return U(D)===!0||D.isFramebufferTexture&&D.minFilter!==sn&&D.minFilter!==_n?Math.log2(Math.max(T.width,T.height))+1:D.mipmaps.length>0?D.mipmaps.length:D.isCompressedTexture&&Array.isArray(D.image)?T.mipmaps.length:1}function q(D){let T=new WeakRef(D);n.get(D).__ref=T,w.add(T),R.register(D,T,T)}function k(D){let T=n.get(D).__ref;T!==void 0&&(w.delete(T),R.unregister(T))}function Y(D){ee(D.target)}function J(D){z(D.target)}function ee(D){D.removeEventListener("dispose",Y),k(D),G(D),D.isVideoTexture&&p.delete(D),D.isHTMLTexture&&_.delete(D)}function z(D){D.removeEventListener("dispose",J),k(D),Se(D)}function ie(){for(let D of w){let T=D.deref();T!==void 0&&(T.isRenderTarget===!0?z(T):ee(T))}w.clear(),_.clear()}function G(D){let T=n.get(D);if(T.__webglInit===void 0)return;let j=D.source,ve=S.get(j);if(ve){let de=ve[T.__cacheKey];de.usedTimes--,de.usedTimes===0&&ne(D),Object.keys(ve).length===0&&S.delete(j)}n.remove(D)}function ne(D){let T=n.get(D);i.deleteTexture(T.__webglTexture);let j=D.source,ve=S.get(j);delete ve[T.__cacheKey],c.memory.textures--}function Se(D){let T=n.get(D);T.__depthDisposeCallback&&T.__depthDisposeCallback();let j=D.depthTexture;if(j&&j.renderTarget===D&&ee(j),D.isWebGLCubeRenderTarget)for(let de=0;de<6;de++){if(Array.isArray(T.__webglFramebuffer[de]))for(let pe=0;pe<T.__webglFramebuffer[de].length;pe++)i.deleteFramebuffer(T.__webglFramebuffer[de][pe]);else i.deleteFramebuffer(T.__webglFramebuffer[de]);T.__webglDepthbuffer&&i.deleteRenderbuffer(T.__webglDepthbuffer[de])}else{if(Array.isArray(T.__webglFramebuffer))for(let de=0;de<T.__webglFramebuffer.length;de++)i.deleteFramebuffer(T.__webglFramebuffer[de]);else i.deleteFramebuffer(T.__webglFramebuffer);if(T.__webglDepthbuffer&&i.deleteRenderbuffer(T.__webglDepthbuffer),T.__webglMultisampledFramebuffer&&i.deleteFramebuffer(T.__webglMultisampledFramebuffer),T.__webglColorRenderbuffer)for(let de=0;de<T.__webglColorRenderbuffer.length;de++)T.__webglColorRenderbuffer[de]&&i.deleteRenderbuffer(T.__webglColorRenderbuffer[de]);T.__webglDepthRenderbuffer&&i.deleteRenderbuffer(T.__webglDepthRenderbuffer)}let ve=D.textures;for(let de=0,pe=ve.length;de<pe;de++){let Me=n.get(ve[de]);Me.__webglTexture&&(i.deleteTexture(Me.__webglTexture),c.memory.textures--),n.remove(ve[de])}n.remove(D)}let re=0;function H(){re=0}function me(){return re}function Xe(D){re=D}function nt(){let D=re;return D>=s.maxTextures&&Qe("WebGLTextures: Trying to use "+(D+1)+" texture units while this GPU supports only "+s.maxTextures),re+=1,D}function ue(D){let T=[];return T.push(D.wrapS),T.push(D.wrapT),T.push(D.wrapR||0),T.push(D.magFilter),T.push(D.minFilter),T.push(D.anisotropy),T.push(D.internalFormat),T.push(D.format),T.push(D.type),T.push(D.generateMipmaps),T.push(D.mipmapsAutoUpdate),T.push(D.premultiplyAlpha),T.push(D.flipY),T.push(D.unpackAlignment),T.push(D.colorSpace),T.join()}function Fe(D,T){let j=n.get(D);if(D.isVideoTexture&&Xt(D),D.isRenderTargetTexture===!1&&D.isExternalTexture!==!0&&D.version>0&&j.__version!==D.version){let ve=D.image;if(ve===null)Qe("WebGLRenderer: Texture marked for update but no image data found.");else if(ve.complete===!1)Qe("WebGLRenderer: Texture marked for update but image is incomplete");else{ht(j,D,T);return}}else D.isExternalTexture&&(j.__webglTexture=D.sourceTexture?D.sourceTexture:null);t.bindTexture(i.TEXTURE_2D,j.__webglTexture,i.TEXTURE0+T)}function Pe(D,T){let j=n.get(D);if(D.isRenderTargetTexture===!1&&D.version>0&&j.__version!==D.version){ht(j,D,T);return}else D.isExternalTexture&&(j.__webglTexture=D.sourceTexture?D.sourceTexture:null);t.bindTexture(i.TEXTURE_2D_ARRAY,j.__webglTexture,i.TEXTURE0+T)}function je(D,T){let j=n.get(D);if(D.isRenderTargetTexture===!1&&D.version>0&&j.__version!==D.version){ht(j,D,T);return}t.bindTexture(i.TEXTURE_3D,j.__webglTexture,i.TEXTURE0+T)}function Ue(D,T){let j=n.get(D);if(D.version>0&&j.__version!==D.version){Rt(j,D,T);return}t.bindTexture(i.TEXTURE_CUBE_MAP,j.__webglTexture,i.TEXTURE0+T)}let rt={[Va]:i.REPEAT,[Qn]:i.CLAMP_TO_EDGE,[Ha]:i.MIRRORED_REPEAT},Gt={[sn]:i.NEAREST,[Yu]:i.NEAREST_MIPMAP_NEAREST,[Is]:i.NEAREST_MIPMAP_LINEAR,[_n]:i.LINEAR,[_o]:i.LINEAR_MIPMAP_NEAREST,[xi]:i.LINEAR_MIPMAP_LINEAR},et={[Ku]:i.NEVER,[Ic]:i.ALWAYS,[Qu]:i.LESS,[Rc]:i.LEQUAL,[ed]:i.EQUAL,[Pc]:i.GEQUAL,[td]:i.GREATER,[nd]:i.NOTEQUAL};function wt(D,T){if(T.type===Gn&&e.has("OES_texture_float_linear")===!1&&(T.magFilter===_n||T.magFilter===_o||T.magFilter===Is||T.magFilter===xi||T.minFilter===_n||T.minFilter===_o||T.minFilter===Is||T.minFilter===xi)&&Qe("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(D,i.TEXTURE_WRAP_S,rt[T.wrapS]),i.texParameteri(D,i.TEXTURE_WRAP_T,rt[T.wrapT]),(D===i.TEXTURE_3D||D===i.TEXTURE_2D_ARRAY)&&i.texParameteri(D,i.TEXTURE_WRAP_R,rt[T.wrapR]),i.texParameteri(D,i.TEXTURE_MAG_FILTER,Gt[T.magFilter]),i.texParameteri(D,i.TEXTURE_MIN_FILTER,Gt[T.minFilter]),T.compareFunction&&(i.texParameteri(D,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(D,i.TEXTURE_COMPARE_FUNC,et[T.compareFunction])),e.has("EXT_texture_filter_anisotropic")===!0){if(T.magFilter===sn||T.minFilter!==Is&&T.minFilter!==xi||T.type===Gn&&e.has("OES_texture_float_linear")===!1)return;if(T.anisotropy>1||n.get(T).__currentAnisotropy){let j=e.get("EXT_texture_filter_anisotropic");i.texParameterf(D,j.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(T.anisotropy,s.getMaxAnisotropy())),n.get(T).__currentAnisotropy=T.anisotropy}}}function Tt(D,T){let j=!1;D.__webglInit===void 0&&(D.__webglInit=!0,T.addEventListener("dispose",Y),q(T));let ve=T.source,de=S.get(ve);de===void 0&&(de={},S.set(ve,de));let pe=ue(T);if(pe!==D.__cacheKey){de[pe]===void 0&&(de[pe]={texture:i.createTexture(),usedTimes:0},c.memory.textures++,j=!0),de[pe].usedTimes++;let Me=de[D.__cacheKey];Me!==void 0&&(de[D.__cacheKey].usedTimes--,Me.usedTimes===0&&ne(T)),D.__cacheKey=pe,D.__webglTexture=de[pe].texture}return j}function dt(D,T,j){return Math.floor(Math.floor(D/j)/T)}function Vt(D,T,j,ve){let pe=D.updateRanges;if(pe.length===0)t.texSubImage2D(i.TEXTURE_2D,0,0,0,T.width,T.height,j,ve,T.data);else{pe.sort((B,he)=>B.start-he.start);let Me=0;for(let B=1;B<pe.length;B++){let he=pe[Me],se=pe[B],Re=he.start+he.count,Ee=dt(se.start,T.width,4),Ae=dt(he.start,T.width,4);se.start<=Re+1&&Ee===Ae&&dt(se.start+se.count-1,T.width,4)===Ee?he.count=Math.max(he.count,se.start+se.count-he.start):(++Me,pe[Me]=se)}pe.length=Me+1;let ae=t.getParameter(i.UNPACK_ROW_LENGTH),le=t.getParameter(i.UNPACK_SKIP_PIXELS),Ce=t.getParameter(i.UNPACK_SKIP_ROWS);t.pixelStorei(i.UNPACK_ROW_LENGTH,T.width);for(let B=0,he=pe.length;B<he;B++){let se=pe[B],Re=Math.floor(se.start/4),Ee=Math.ceil(se.count/4),Ae=Re%T.width,$e=Math.floor(Re/T.width),ot=Ee,we=1;t.pixelStorei(i.UNPACK_SKIP_PIXELS,Ae),t.pixelStorei(i.UNPACK_SKIP_ROWS,$e),t.texSubImage2D(i.TEXTURE_2D,0,Ae,$e,ot,we,j,ve,T.data)}D.clearUpdateRanges(),t.pixelStorei(i.UNPACK_ROW_LENGTH,ae),t.pixelStorei(i.UNPACK_SKIP_PIXELS,le),t.pixelStorei(i.UNPACK_SKIP_ROWS,Ce)}}function ht(D,T,j){let ve=i.TEXTURE_2D;(T.isDataArrayTexture||T.isCompressedArrayTexture)&&(ve=i.TEXTURE_2D_ARRAY),T.isData3DTexture&&(ve=i.TEXTURE_3D);let de=Tt(D,T),pe=T.source;t.bindTexture(ve,D.__webglTexture,i.TEXTURE0+j);let Me=n.get(pe);if(pe.version!==Me.__version||de===!0){if(t.activeTexture(i.TEXTURE0+j),(typeof ImageBitmap<"u"&&T.image instanceof ImageBitmap)===!1){let we=yt.getPrimaries(yt.workingColorSpace),Ye=T.colorSpace===Mi?null:yt.getPrimaries(T.colorSpace),lt=T.colorSpace===Mi||we===Ye?i.NONE:i.BROWSER_DEFAULT_WEBGL;t.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,T.flipY),t.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,T.premultiplyAlpha),t.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,lt)}t.pixelStorei(i.UNPACK_ALIGNMENT,T.unpackAlignment);let le=P(T.image,!1,s.maxTextureSize);le=Je(T,le);let Ce=o.convert(T.format,T.colorSpace),B=o.convert(T.type),he=N(T.internalFormat,Ce,B,T.normalized,T.colorSpace,T.isVideoTexture);wt(ve,T);let se,Re=T.mipmaps,Ee=T.isVideoTexture!==!0,Ae=Me.__version===void 0||de===!0,$e=pe.dataReady,ot=L(T,le);if(T.isDepthTexture)he=b(T.format===Si,T.type),Ae&&(Ee?t.texStorage2D(i.TEXTURE_2D,1,he,le.width,le.height):t.texImage2D(i.TEXTURE_2D,0,he,le.width,le.height,0,Ce,B,null));else if(T.isDataTexture)if(Re.length>0){Ee&&Ae&&t.texStorage2D(i.TEXTURE_2D,ot,he,Re[0].width,Re[0].height);for(let we=0,Ye=Re.length;we<Ye;we++)se=Re[we],Ee?$e&&t.texSubImage2D(i.TEXTURE_2D,we,0,0,se.width,se.height,Ce,B,se.data):t.texImage2D(i.TEXTURE_2D,we,he,se.width,se.height,0,Ce,B,se.data);T.generateMipmaps=!1}else Ee?(Ae&&t.texStorage2D(i.TEXTURE_2D,ot,he,le.width,le.height),$e&&Vt(T,le,Ce,B)):t.texImage2D(i.TEXTURE_2D,0,he,le.width,le.height,0,Ce,B,le.data);else if(T.isCompressedTexture)if(T.isCompressedArrayTexture){Ee&&Ae&&t.texStorage3D(i.TEXTURE_2D_ARRAY,ot,he,Re[0].width,Re[0].height,le.depth);for(let we=0,Ye=Re.length;we<Ye;we++)if(se=Re[we],T.format!==Hn)if(Ce!==null)if(Ee){if($e)if(T.layerUpdates.size>0){let lt=zc(se.width,se.height,T.format,T.type);for(let Oe of T.layerUpdates){let Et=se.data.subarray(Oe*lt/se.data.BYTES_PER_ELEMENT,(Oe+1)*lt/se.data.BYTES_PER_ELEMENT);t.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,we,0,0,Oe,se.width,se.height,1,Ce,Et)}}else t.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,we,0,0,0,se.width,se.height,le.depth,Ce,se.data)}else t.compressedTexImage3D(i.TEXTURE_2D_ARRAY,we,he,se.width,se.height,le.depth,0,se.data,0,0);else Qe("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else Ee?$e&&t.texSubImage3D(i.TEXTURE_2D_ARRAY,we,0,0,0,se.width,se.height,le.depth,Ce,B,se.data):t.texImage3D(i.TEXTURE_2D_ARRAY,we,he,se.width,se.height,le.depth,0,Ce,B,se.data);T.layerUpdates.size>0&&T.clearLayerUpdates()}else{Ee&&Ae&&t.texStorage2D(i.TEXTURE_2D,ot,he,Re[0].width,Re[0].height);for(let we=0,Ye=Re.length;we<Ye;we++)se=Re[we],T.format!==Hn?Ce!==null?Ee?$e&&t.compressedTexSubImage2D(i.TEXTURE_2D,we,0,0,se.width,se.height,Ce,se.data):t.compressedTexImage2D(i.TEXTURE_2D,we,he,se.width,se.height,0,se.data):Qe("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):Ee?$e&&t.texSubImage2D(i.TEXTURE_2D,we,0,0,se.width,se.height,Ce,B,se.data):t.texImage2D(i.TEXTURE_2D,we,he,se.width,se.height,0,Ce,B,se.data)}else if(T.isDataArrayTexture)if(Ee){if(Ae&&t.texStorage3D(i.TEXTURE_2D_ARRAY,ot,he,le.width,le.height,le.depth),$e)if(T.layerUpdates.size>0){let we=zc(le.width,le.height,T.format,T.type);for(let Ye of T.layerUpdates){let lt=le.data.subarray(Ye*we/le.data.BYTES_PER_ELEMENT,(Ye+1)*we/le.data.BYTES_PER_ELEMENT);t.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,Ye,le.width,le.height,1,Ce,B,lt)}T.clearLayerUpdates()}else t.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,le.width,le.height,le.depth,Ce,B,le.data)}else t.texImage3D(i.TEXTURE_2D_ARRAY,0,he,le.width,le.height,le.depth,0,Ce,B,le.data);else if(T.isData3DTexture)Ee?(Ae&&t.texStorage3D(i.TEXTURE_3D,ot,he,le.width,le.height,le.depth),$e&&t.texSubImage3D(i.TEXTURE_3D,0,0,0,0,le.width,le.height,le.depth,Ce,B,le.data)):t.texImage3D(i.TEXTURE_3D,0,he,le.width,le.height,le.depth,0,Ce,B,le.data);else if(T.isFramebufferTexture){if(Ae)if(Ee)t.texStorage2D(i.TEXTURE_2D,ot,he,le.width,le.height);else{let we=le.width,Ye=le.height;for(let lt=0;lt<ot;lt++)t.texImage2D(i.TEXTURE_2D,lt,he,we,Ye,0,Ce,B,null),we>>=1,Ye>>=1}}else if(T.isHTMLTexture){if("texElementImage2D"in i){let we=i.canvas;if(we.hasAttribute("layoutsubtree")||we.setAttribute("layoutsubtree","true"),le.parentNode!==we){we.appendChild(le),_.add(T),we.onpaint=Ye=>{let lt=Ye.changedElements;for(let Oe of _)lt.includes(Oe.image)&&(Oe.needsUpdate=!0)},we.requestPaint();return}if(i.texElementImage2D.length===3)i.texElementImage2D(i.TEXTURE_2D,i.RGBA8,le);else{let lt=i.RGBA,Oe=i.RGBA,Et=i.UNSIGNED_BYTE;i.texElementImage2D(i.TEXTURE_2D,0,lt,Oe,Et,le)}i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MIN_FILTER,i.LINEAR),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_S,i.CLAMP_TO_EDGE),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_T,i.CLAMP_TO_EDGE)}}else if(Re.length>0){if(Ee&&Ae){let we=Ze(Re[0]);t.texStorage2D(i.TEXTURE_2D,ot,he,we.width,we.height)}for(let we=0,Ye=Re.length;we<Ye;we++)se=Re[we],Ee?$e&&t.texSubImage2D(i.TEXTURE_2D,we,0,0,Ce,B,se):t.texImage2D(i.TEXTURE_2D,we,he,Ce,B,se);T.generateMipmaps=!1}else if(Ee){if(Ae){let we=Ze(le);t.texStorage2D(i.TEXTURE_2D,ot,he,we.width,we.height)}$e&&t.texSubImage2D(i.TEXTURE_2D,0,0,0,Ce,B,le)}else t.texImage2D(i.TEXTURE_2D,0,he,Ce,B,le);U(T)&&T.mipmapsAutoUpdate===!0&&I(ve),Me.__version=pe.version,T.onUpdate&&T.onUpdate(T)}D.__version=T.version}function Rt(D,T,j){if(T.image.length!==6)return;let ve=Tt(D,T),de=T.source;t.bindTexture(i.TEXTURE_CUBE_MAP,D.__webglTexture,i.TEXTURE0+j);let pe=n.get(de);if(de.version!==pe.__version||ve===!0){t.activeTexture(i.TEXTURE0+j);let Me=yt.getPrimaries(yt.workingColorSpace),ae=T.colorSpace===Mi?null:yt.getPrimaries(T.colorSpace),le=T.colorSpace===Mi||Me===ae?i.NONE:i.BROWSER_DEFAULT_WEBGL;t.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,T.flipY),t.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,T.premultiplyAlpha),t.pixelStorei(i.UNPACK_ALIGNMENT,T.unpackAlignment),t.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,le);let Ce=T.isCompressedTexture||T.image[0].isCompressedTexture,B=T.image[0]&&T.image[0].isDataTexture,he=[];for(let Oe=0;Oe<6;Oe++)!Ce&&!B?he[Oe]=P(T.image[Oe],!0,s.maxCubemapSize):he[Oe]=B?T.image[Oe].image:T.image[Oe],he[Oe]=Je(T,he[Oe]);let se=he[0],Re=o.convert(T.format,T.colorSpace),Ee=o.convert(T.type),Ae=N(T.internalFormat,Re,Ee,T.normalized,T.colorSpace),$e=T.isVideoTexture!==!0,ot=pe.__version===void 0||ve===!0,we=de.dataReady,Ye=L(T,se);wt(i.TEXTURE_CUBE_MAP,T);let lt;if(T.isDepthTexture){if(Ae=b(T.format===Si,T.type),ot)if($e)t.texStorage2D(i.TEXTURE_CUBE_MAP,1,Ae,se.width,se.height);else for(let Oe=0;Oe<6;Oe++)t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Oe,0,Ae,se.width,se.height,0,Re,Ee,null)}else if(Ce){$e&&ot&&t.texStorage2D(i.TEXTURE_CUBE_MAP,Ye,Ae,se.width,se.height);for(let Oe=0;Oe<6;Oe++){lt=he[Oe].mipmaps;for(let Et=0;Et<lt.length;Et++){let Ot=lt[Et];T.format!==Hn?Re!==null?$e?we&&t.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Oe,Et,0,0,Ot.width,Ot.height,Re,Ot.data):t.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Oe,Et,Ae,Ot.width,Ot.height,0,Ot.data):Qe("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):$e?we&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Oe,Et,0,0,Ot.width,Ot.height,Re,Ee,Ot.data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Oe,Et,Ae,Ot.width,Ot.height,0,Re,Ee,Ot.data)}}}else{if(lt=T.mipmaps,$e&&ot){lt.length>0&&Ye++;let Oe=Ze(he[0]);t.texStorage2D(i.TEXTURE_CUBE_MAP,Ye,Ae,Oe.width,Oe.height)}for(let Oe=0;Oe<6;Oe++)if(B){$e?we&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Oe,0,0,0,he[Oe].width,he[Oe].height,Re,Ee,he[Oe].data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Oe,0,Ae,he[Oe].width,he[Oe].height,0,Re,Ee,he[Oe].data);for(let Et=0;Et<lt.length;Et++){let li=lt[Et].image[Oe].image;$e?we&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Oe,Et+1,0,0,li.width,li.height,Re,Ee,li.data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Oe,Et+1,Ae,li.width,li.height,0,Re,Ee,li.data)}}else{$e?we&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Oe,0,0,0,Re,Ee,he[Oe]):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Oe,0,Ae,Re,Ee,he[Oe]);for(let Et=0;Et<lt.length;Et++){let Ot=lt[Et];$e?we&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Oe,Et+1,0,0,Re,Ee,Ot.image[Oe]):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Oe,Et+1,Ae,Re,Ee,Ot.image[Oe])}}}U(T)&&T.mipmapsAutoUpdate===!0&&I(i.TEXTURE_CUBE_MAP),pe.__version=de.version,T.onUpdate&&T.onUpdate(T)}D.__version=T.version}function St(D,T,j,ve,de,pe){let Me=o.convert(j.format,j.colorSpace),ae=o.convert(j.type),le=N(j.internalFormat,Me,ae,j.normalized,j.colorSpace),Ce=n.get(T),B=n.get(j);if(B.__renderTarget=T,!Ce.__hasExternalTextures){let he=Math.max(1,T.width>>pe),se=Math.max(1,T.height>>pe);de===i.TEXTURE_3D||de===i.TEXTURE_2D_ARRAY?t.texImage3D(de,pe,le,he,se,T.depth,0,Me,ae,null):t.texImage2D(de,pe,le,he,se,0,Me,ae,null)}t.bindFramebuffer(i.FRAMEBUFFER,D),De(T)?h.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ve,de,B.__webglTexture,0,Nt(T)):(de===i.TEXTURE_2D||de>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&de<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,ve,de,B.__webglTexture,pe),t.bindFramebuffer(i.FRAMEBUFFER,null)}function Qt(D,T,j){if(i.bindRenderbuffer(i.RENDERBUFFER,D),T.depthBuffer){let ve=T.depthTexture,de=ve&&ve.isDepthTexture?ve.type:null,pe=b(T.stencilBuffer,de),Me=T.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;De(T)?h.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,Nt(T),pe,T.width,T.height):j?i.renderbufferStorageMultisample(i.RENDERBUFFER,Nt(T),pe,T.width,T.height):i.renderbufferStorage(i.RENDERBUFFER,pe,T.width,T.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,Me,i.RENDERBUFFER,D)}else{let ve=T.textures;for(let de=0;de<ve.length;de++){let pe=ve[de],Me=o.convert(pe.format,pe.colorSpace),ae=o.convert(pe.type),le=N(pe.internalFormat,Me,ae,pe.normalized,pe.colorSpace);De(T)?h.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,Nt(T),le,T.width,T.height):j?i.renderbufferStorageMultisample(i.RENDERBUFFER,Nt(T),le,T.width,T.height):i.renderbufferStorage(i.RENDERBUFFER,le,T.width,T.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function Le(D,T,j){let ve=T.isWebGLCubeRenderTarget===!0;if(t.bindFramebuffer(i.FRAMEBUFFER,D),!(T.depthTexture&&T.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let de=n.get(T.depthTexture);de.__renderTarget=T;let pe=ve?T.depthTexture.image[0]:T.depthTexture.image;(!de.__webglTexture||pe.width!==T.width||pe.height!==T.height)&&(pe.width=T.width,pe.height=T.height,T.depthTexture.needsUpdate=!0),ve?Ue(T.depthTexture,0):Fe(T.depthTexture,0);let Me=de.__webglTexture,ae=Nt(T),le=ve?i.TEXTURE_CUBE_MAP_POSITIVE_X+j:i.TEXTURE_2D,Ce=T.depthTexture.format===Si?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;if(T.depthTexture.format===gi)De(T)?h.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,Ce,le,Me,0,ae):i.framebufferTexture2D(i.FRAMEBUFFER,Ce,le,Me,0);else if(T.depthTexture.format===Si)De(T)?h.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,Ce,le,Me,0,ae):i.framebufferTexture2D(i.FRAMEBUFFER,Ce,le,Me,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function qe(D){let T=n.get(D),j=D.isWebGLCubeRenderTarget===!0;if(T.__boundDepthTexture!==D.depthTexture){let ve=D.depthTexture;if(T.__depthDisposeCallback&&T.__depthDisposeCallback(),ve){let de=()=>{delete T.__boundDepthTexture,delete T.__depthDisposeCallback,ve.removeEventListener("dispose",de)};ve.addEventListener("dispose",de),T.__depthDisposeCallback=de}T.__boundDepthTexture=ve}if(D.depthTexture&&!T.__autoAllocateDepthBuffer)if(j)for(let ve=0;ve<6;ve++)Le(T.__webglFramebuffer[ve],D,ve);else D.texture.mipmaps.length>0?Le(T.__webglFramebuffer[0],D,0):Le(T.__webglFramebuffer,D,0);else if(j){T.__webglDepthbuffer=[];for(let ve=0;ve<6;ve++)if(t.bindFramebuffer(i.FRAMEBUFFER,T.__webglFramebuffer[ve]),T.__webglDepthbuffer[ve]===void 0)T.__webglDepthbuffer[ve]=i.createRenderbuffer(),Qt(T.__webglDepthbuffer[ve],D,!1);else{let de=D.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,pe=T.__webglDepthbuffer[ve];i.bindRenderbuffer(i.RENDERBUFFER,pe),i.framebufferRenderbuffer(i.FRAMEBUFFER,de,i.RENDERBUFFER,pe)}}else if(D.texture.mipmaps.length>0?t.bindFramebuffer(i.FRAMEBUFFER,T.__webglFramebuffer[0]):t.bindFramebuffer(i.FRAMEBUFFER,T.__webglFramebuffer),T.__webglDepthbuffer===void 0)T.__webglDepthbuffer=i.createRenderbuffer(),Qt(T.__webglDepthbuffer,D,!1);else{let de=D.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,pe=T.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,pe),i.framebufferRenderbuffer(i.FRAMEBUFFER,de,i.RENDERBUFFER,pe)}t.bindFramebuffer(i.FRAMEBUFFER,null)}function an(D,T,j){let ve=n.get(D);T!==void 0&&St(ve.__webglFramebuffer,D,D.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),j!==void 0&&qe(D)}function en(D){let T=D.texture,j=n.get(D),ve=n.get(T);D.addEventListener("dispose",J),q(D);let de=D.textures,pe=D.isWebGLCubeRenderTarget===!0,Me=de.length>1;if(Me||(ve.__webglTexture===void 0&&(ve.__webglTexture=i.createTexture()),ve.__version=T.version,c.memory.textures++),pe){j.__webglFramebuffer=[];for(let ae=0;ae<6;ae++)if(T.mipmaps.length>0){j.__webglFramebuffer[ae]=[];for(let le=0;le<T.mipmaps.length;le++)j.__webglFramebuffer[ae][le]=i.createFramebuffer()}else j.__webglFramebuffer[ae]=i.createFramebuffer()}else{if(T.mipmaps.length>0){j.__webglFramebuffer=[];for(let ae=0;ae<T.mipmaps.length;ae++)j.__webglFramebuffer[ae]=i.createFramebuffer()}else j.__webglFramebuffer=i.createFramebuffer();if(Me)for(let ae=0,le=de.length;ae<le;ae++){let Ce=n.get(de[ae]);Ce.__webglTexture===void 0&&(Ce.__webglTexture=i.createTexture(),c.memory.textures++)}if(D.samples>0&&De(D)===!1){j.__webglMultisampledFramebuffer=i.createFramebuffer(),j.__webglColorRenderbuffer=[],t.bindFramebuffer(i.FRAMEBUFFER,j.__webglMultisampledFramebuffer);for(let ae=0;ae<de.length;ae++){let le=de[ae];j.__webglColorRenderbuffer[ae]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,j.__webglColorRenderbuffer[ae]);let Ce=o.convert(le.format,le.colorSpace),B=o.convert(le.type),he=N(le.internalFormat,Ce,B,le.normalized,le.colorSpace,D.isXRRenderTarget===!0),se=Nt(D);i.renderbufferStorageMultisample(i.RENDERBUFFER,se,he,D.width,D.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ae,i.RENDERBUFFER,j.__webglColorRenderbuffer[ae])}i.bindRenderbuffer(i.RENDERBUFFER,null),D.depthBuffer&&(j.__webglDepthRenderbuffer=i.createRenderbuffer(),Qt(j.__webglDepthRenderbuffer,D,!0)),t.bindFramebuffer(i.FRAMEBUFFER,null)}}if(pe){t.bindTexture(i.TEXTURE_CUBE_MAP,ve.__webglTexture),wt(i.TEXTURE_CUBE_MAP,T);for(let ae=0;ae<6;ae++)if(T.mipmaps.length>0)for(let le=0;le<T.mipmaps.length;le++)St(j.__webglFramebuffer[ae][le],D,T,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+ae,le);else St(j.__webglFramebuffer[ae],D,T,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+ae,0);U(T)?I(i.TEXTURE_CUBE_MAP):T.mipmaps.length>0&&i.texParameteri(i.TEXTURE_CUBE_MAP,i.TEXTURE_MAX_LEVEL,T.mipmaps.length-1),t.unbindTexture()}else if(Me){for(let ae=0,le=de.length;ae<le;ae++){let Ce=de[ae],B=n.get(Ce),he=i.TEXTURE_2D;(D.isWebGL3DRenderTarget||D.isWebGLArrayRenderTarget)&&(he=D.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),t.bindTexture(he,B.__webglTexture),wt(he,Ce),St(j.__webglFramebuffer,D,Ce,i.COLOR_ATTACHMENT0+ae,he,0),U(Ce)&&I(he)}t.unbindTexture()}else{let ae=i.TEXTURE_2D;if((D.isWebGL3DRenderTarget||D.isWebGLArrayRenderTarget)&&(ae=D.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),t.bindTexture(ae,ve.__webglTexture),wt(ae,T),T.mipmaps.length>0)for(let le=0;le<T.mipmaps.length;le++)St(j.__webglFramebuffer[le],D,T,i.COLOR_ATTACHMENT0,ae,le);else St(j.__webglFramebuffer,D,T,i.COLOR_ATTACHMENT0,ae,0);U(T)?I(ae):T.mipmaps.length>0&&i.texParameteri(ae,i.TEXTURE_MAX_LEVEL,T.mipmaps.length-1),t.unbindTexture()}D.depthBuffer&&qe(D)}function W(D){let T=D.textures;for(let j=0,ve=T.length;j<ve;j++){let de=T[j];if(U(de)&&de.mipmapsAutoUpdate===!0){let pe=O(D),Me=n.get(de).__webglTexture;t.bindTexture(pe,Me),I(pe),t.unbindTexture()}}}let fn=[];function At(D){if(D.samples>0){if(De(D)===!1){let T=D.textures,j=D.width,ve=D.height,de=i.COLOR_BUFFER_BIT,pe=D.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,Me=n.get(D),ae=T.length>1;if(ae)for(let Ce=0;Ce<T.length;Ce++)t.bindFramebuffer(i.FRAMEBUFFER,Me.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+Ce,i.RENDERBUFFER,null),t.bindFramebuffer(i.FRAMEBUFFER,Me.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+Ce,i.TEXTURE_2D,null,0);t.bindFramebuffer(i.READ_FRAMEBUFFER,Me.__webglMultisampledFramebuffer),D.texture.mipmaps.length>0?t.bindFramebuffer(i.DRAW_FRAMEBUFFER,Me.__webglFramebuffer[0]):t.bindFramebuffer(i.DRAW_FRAMEBUFFER,Me.__webglFramebuffer);for(let Ce=0;Ce<T.length;Ce++){if(D.resolveDepthBuffer&&(D.depthBuffer&&(de|=i.DEPTH_BUFFER_BIT),D.stencilBuffer&&D.resolveStencilBuffer&&(de|=i.STENCIL_BUFFER_BIT)),ae){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,Me.__webglColorRenderbuffer[Ce]);let B=n.get(T[Ce]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,B,0)}i.blitFramebuffer(0,0,j,ve,0,0,j,ve,de,i.NEAREST),d===!0&&(fn.length=0,fn.push(i.COLOR_ATTACHMENT0+Ce),D.depthBuffer&&D.storeMultisampledDepthBuffer===!1&&fn.push(pe),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,fn))}if(t.bindFramebuffer(i.READ_FRAMEBUFFER,null),t.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),ae)for(let Ce=0;Ce<T.length;Ce++){t.bindFramebuffer(i.FRAMEBUFFER,Me.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+Ce,i.RENDERBUFFER,Me.__webglColorRenderbuffer[Ce]);let B=n.get(T[Ce]).__webglTexture;t.bindFramebuffer(i.FRAMEBUFFER,Me.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+Ce,i.TEXTURE_2D,B,0)}t.bindFramebuffer(i.DRAW_FRAMEBUFFER,Me.__webglMultisampledFramebuffer)}else if(D.depthBuffer&&D.storeMultisampledDepthBuffer===!1&&d){let T=D.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[T])}}}function Nt(D){return Math.min(s.maxSamples,D.samples)}function De(D){let T=n.get(D);return D.samples>0&&e.has("WEBGL_multisampled_render_to_texture")===!0&&T.__useRenderToTexture!==!1}function Xt(D){let T=c.render.frame;p.get(D)!==T&&(p.set(D,T),D.update())}function Je(D,T){let j=D.colorSpace,ve=D.format,de=D.type;return D.isCompressedTexture===!0||D.isVideoTexture===!0||j!==hs&&j!==Mi&&(yt.getTransfer(j)===Ct?(ve!==Hn||de!==Sn)&&Qe("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):tt("WebGLTextures: Unsupported texture color space:",j)),T}function Ze(D){return typeof HTMLImageElement<"u"&&D instanceof HTMLImageElement?(f.width=D.naturalWidth||D.width,f.height=D.naturalHeight||D.height):typeof VideoFrame<"u"&&D instanceof VideoFrame?(f.width=D.displayWidth,f.height=D.displayHeight):(f.width=D.width,f.height=D.height),f}this.allocateTextureUnit=nt,this.resetTextureUnits=H,this.getTextureUnits=me,this.setTextureUnits=Xe,this.setTexture2D=Fe,this.setTexture2DArray=Pe,this.setTexture3D=je,this.setTextureCube=Ue,this.rebindTextures=an,this.setupRenderTarget=en,this.updateRenderTargetMipmap=W,this.updateMultisampleRenderTarget=At,this.setupDepthRenderbuffer=qe,this.setupFrameBufferTexture=St,this.useMultisampledRTT=De,this.dispose=ie}function GM(i,e){function t(n,s=Mi){let o,c=yt.getTransfer(s);if(n===Sn)return i.UNSIGNED_BYTE;if(n===yo)return i.UNSIGNED_SHORT_4_4_4_4;if(n===xo)return i.UNSIGNED_SHORT_5_5_5_1;if(n===wc)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===Ec)return i.UNSIGNED_INT_10F_11F_11F_REV;if(n===Mc)return i.BYTE;if(n===bc)return i.SHORT;if(n===Hr)return i.UNSIGNED_SHORT;if(n===vo)return i.INT;if(n===zn)return i.UNSIGNED_INT;if(n===Gn)return i.FLOAT;if(n===Vn)return i.HALF_FLOAT;if(n===Tc)return i.ALPHA;if(n===Ac)return i.RGB;if(n===Hn)return i.RGBA;if(n===gi)return i.DEPTH_COMPONENT;if(n===Si)return i.DEPTH_STENCIL;if(n===Cc)return i.RED;if(n===So)return i.RED_INTEGER;if(n===Bi)return i.RG;if(n===Mo)return i.RG_INTEGER;if(n===bo)return i.RGBA_INTEGER;if(n===Ls||n===Ds||n===Fs||n===Ns)if(c===Ct)if(o=e.get("WEBGL_compressed_texture_s3tc_srgb"),o!==null){if(n===Ls)return o.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===Ds)return o.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===Fs)return o.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===Ns)return o.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(o=e.get("WEBGL_compressed_texture_s3tc"),o!==null){if(n===Ls)return o.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===Ds)return o.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===Fs)return o.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===Ns)return o.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===wo||n===Eo||n===To||n===Ao)if(o=e.get("WEBGL_compressed_texture_pvrtc"),o!==null){if(n===wo)return o.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===Eo)return o.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===To)return o.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===Ao)return o.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===Co||n===Ro||n===Po||n===Io||n===Lo||n===Us||n===Do)if(o=e.get("WEBGL_compressed_texture_etc"),o!==null){if(n===Co||n===Ro)return c===Ct?o.COMPRESSED_SRGB8_ETC2:o.COMPRESSED_RGB8_ETC2;if(n===Po)return c===Ct?o.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:o.COMPRESSED_RGBA8_ETC2_EAC;if(n===Io)return o.COMPRESSED_R11_EAC;if(n===Lo)return o.COMPRESSED_SIGNED_R11_EAC;if(n===Us)return o.COMPRESSED_RG11_EAC;if(n===Do)return o.COMPRESSED_SIGNED_RG11_EAC}else return null;if(n===Fo||n===No||n===Uo||n===Oo||n===Bo||n===ko||n===zo||n===Go||n===Vo||n===Ho||n===Wo||n===Xo||n===$o||n===qo)if(o=e.get("WEBGL_compressed_texture_astc"),o!==null){if(n===Fo)return c===Ct?o.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:o.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===No)return c===Ct?o.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:o.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===Uo)return c===Ct?o.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:o.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===Oo)return c===Ct?o.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:o.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===Bo)return c===Ct?o.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:o.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===ko)return c===Ct?o.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:o.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===zo)return c===Ct?o.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:o.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===Go)return c===Ct?o.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:o.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===Vo)return c===Ct?o.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:o.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===Ho)return c===Ct?o.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:o.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===Wo)return c===Ct?o.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:o.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===Xo)return c===Ct?o.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:o.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===$o)return c===Ct?o.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:o.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===qo)return c===Ct?o.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:o.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===Yo||n===jo||n===Jo)if(o=e.get("EXT_texture_compression_bptc"),o!==null){if(n===Yo)return c===Ct?o.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:o.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===jo)return o.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===Jo)return o.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===Zo||n===Ko||n===Os||n===Qo)if(o=e.get("EXT_texture_compression_rgtc"),o!==null){if(n===Zo)return o.COMPRESSED_RED_RGTC1_EXT;if(n===Ko)return o.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===Os)return o.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===Qo)return o.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===ar?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:t}}var VM=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,HM=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,jc=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(e,t){if(this.texture===null){let n=new xs(e.texture);(e.depthNear!==t.depthNear||e.depthFar!==t.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=n}}getMesh(e){if(this.texture!==null&&this.mesh===null){let t=e.cameras[0].viewport,n=new ii({vertexShader:VM,fragmentShader:HM,uniforms:{depthColor:{value:this.texture},depthWidth:{value:t.z},depthHeight:{value:t.w}}});this.mesh=new Ln(new bs(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},Jc=class extends ti{constructor(e,t){super();let n=this,s=null,o=1,c=null,h="local-floor",d=1,f=null,p=null,_=null,g=null,S=null,w=null,R=typeof XRWebGLBinding<"u",x=new jc,y={},P=t.getContextAttributes(),U=null,I=null,O=[],N=[],b=new gt,L=null,q=null,k=new gn;k.viewport=new zt;let Y=new gn;Y.viewport=new zt;let J=[k,Y],ee=new po,z=null,ie=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(ue){let Fe=O[ue];return Fe===void 0&&(Fe=new Fr,O[ue]=Fe),Fe.getTargetRaySpace()},this.getControllerGrip=function(ue){let Fe=O[ue];return Fe===void 0&&(Fe=new Fr,O[ue]=Fe),Fe.getGripSpace()},this.getHand=function(ue){let Fe=O[ue];return Fe===void 0&&(Fe=new Fr,O[ue]=Fe),Fe.getHandSpace()};function G(ue){let Fe=N.indexOf(ue.inputSource);if(Fe===-1)return;let Pe=O[Fe];Pe!==void 0&&(Pe.update(ue.inputSource,ue.frame,f||c),Pe.dispatchEvent({type:ue.type,data:ue.inputSource}))}function ne(){s.removeEventListener("select",G),s.removeEventListener("selectstart",G),s.removeEventListener("selectend",G),s.removeEventListener("squeeze",G),s.removeEventListener("squeezestart",G),s.removeEventListener("squeezeend",G),s.removeEventListener("end",ne),s.removeEventListener("inputsourceschange",Se);for(let ue=0;ue<O.length;ue++){let Fe=N[ue];Fe!==null&&(N[ue]=null,O[ue].disconnect(Fe))}z=null,ie=null,x.reset();for(let ue in y)delete y[ue];if(e.setRenderTarget(U),S=null,g=null,_=null,s=null,I=null,nt.stop(),n.isPresenting=!1,e.setPixelRatio(L),e.setSize(b.width,b.height,!1),q!==null){let ue=q.camera;ue.fov=q.fov,ue.zoom=q.zoom,ue.updateProjectionMatrix(),q=null}n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(ue){o=ue,n.isPresenting===!0&&Qe("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(ue){h=ue,n.isPresenting===!0&&Qe("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return f||c},this.setReferenceSpace=function(ue){f=ue},this.getBaseLayer=function(){return g!==null?g:S},this.getBinding=function(){return _===null&&R&&(_=new XRWebGLBinding(s,t)),_},this.getFrame=function(){return w},this.getSession=function(){return s},this.setSession=async function(ue){if(s=ue,s!==null){if(U=e.getRenderTarget(),s.addEventListener("select",G),s.addEventListener("selectstart",G),s.addEventListener("selectend",G),s.addEventListener("squeeze",G),s.addEventListener("squeezestart",G),s.addEventListener("squeezeend",G),s.addEventListener("end",ne),s.addEventListener("inputsourceschange",Se),P.xrCompatible!==!0&&await t.makeXRCompatible(),L=e.getPixelRatio(),e.getSize(b),R&&"createProjectionLayer"in XRWebGLBinding.prototype){let Pe=null,je=null,Ue=null;P.depth&&(Ue=P.stencil?t.DEPTH24_STENCIL8:t.DEPTH_COMPONENT24,Pe=P.stencil?Si:gi,je=P.stencil?ar:zn);let rt={colorFormat:t.RGBA8,depthFormat:Ue,scaleFactor:o};_=this.getBinding(),g=_.createProjectionLayer(rt),s.updateRenderState({layers:[g]}),e.setPixelRatio(1),e.setSize(g.textureWidth,g.textureHeight,!1),I=new En(g.textureWidth,g.textureHeight,{format:Hn,type:Sn,depthTexture:new yi(g.textureWidth,g.textureHeight,je,void 0,void 0,void 0,void 0,void 0,void 0,Pe),stencilBuffer:P.stencil,colorSpace:e.outputColorSpace,samples:P.antialias?4:0,resolveDepthBuffer:g.ignoreDepthValues===!1,resolveStencilBuffer:g.ignoreDepthValues===!1,storeMultisampledDepthBuffer:g.ignoreDepthValues===!1,storeMultisampledStencilBuffer:g.ignoreDepthValues===!1})}else{let Pe={antialias:P.antialias,alpha:!0,depth:P.depth,stencil:P.stencil,framebufferScaleFactor:o};S=new XRWebGLLayer(s,t,Pe),s.updateRenderState({baseLayer:S}),e.setPixelRatio(1),e.setSize(S.framebufferWidth,S.framebufferHeight,!1),I=new En(S.framebufferWidth,S.framebufferHeight,{format:Hn,type:Sn,colorSpace:e.outputColorSpace,stencilBuffer:P.stencil,resolveDepthBuffer:S.ignoreDepthValues===!1,resolveStencilBuffer:S.ignoreDepthValues===!1,storeMultisampledDepthBuffer:S.ignoreDepthValues===!1,storeMultisampledStencilBuffer:S.ignoreDepthValues===!1})}I.isXRRenderTarget=!0,this.setFoveation(d),f=null,c=await s.requestReferenceSpace(h),nt.setContext(s),nt.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return x.getDepthTexture()};function Se(ue){for(let Fe=0;Fe<ue.removed.length;Fe++){let Pe=ue.removed[Fe],je=N.indexOf(Pe);je>=0&&(N[je]=null,O[je].disconnect(Pe))}for(let Fe=0;Fe<ue.added.length;Fe++){let Pe=ue.added[Fe],je=N.indexOf(Pe);if(je===-1){for(let rt=0;rt<O.length;rt++)if(rt>=N.length){N.push(Pe),je=rt;break}else if(N[rt]===null){N[rt]=Pe,je=rt;break}if(je===-1)break}let Ue=O[je];Ue&&Ue.connect(Pe)}}function re(ue,Fe){Fe===null?ue.matrixWorld.copy(ue.matrix):ue.matrixWorld.multiplyMatrices(Fe.matrixWorld,ue.matrix),ue.matrixWorldInverse.copy(ue.matrixWorld).invert()}this.updateCamera=function(ue){if(s===null)return;let Fe=ue.near,Pe=ue.far;x.texture!==null&&(x.depthNear>0&&(Fe=x.depthNear),x.depthFar>0&&(Pe=x.depthFar)),ee.near=Y.near=k.near=Fe,ee.far=Y.far=k.far=Pe,(z!==ee.near||ie!==ee.far)&&(s.updateRenderState({depthNear:ee.near,depthFar:ee.far}),z=ee.near,ie=ee.far),ee.layers.mask=ue.layers.mask|6,k.layers.mask=ee.layers.mask&-5,Y.layers.mask=ee.layers.mask&-3;let je=ue.parent,Ue=ee.cameras;re(ee,je);for(let rt=0;rt<Ue.length;rt++)re(Ue[rt],je);ee.projectionMatrix.copy(k.projectionMatrix),ee.projectionMatrixInverse.copy(k.projectionMatrixInverse),q===null&&ue.isPerspectiveCamera&&(q={camera:ue,fov:ue.fov,zoom:ue.zoom}),H(ue,ee,je)};function H(ue,Fe,Pe){Pe===null?ue.matrix.copy(Fe.matrixWorld):(ue.matrix.copy(Pe.matrixWorld),ue.matrix.invert(),ue.matrix.multiply(Fe.matrixWorld)),ue.matrix.decompose(ue.position,ue.quaternion,ue.scale),ue.updateMatrixWorld(!0),ue.projectionMatrix.copy(Fe.projectionMatrix),ue.projectionMatrixInverse.copy(Fe.projectionMatrixInverse),ue.isPerspectiveCamera&&(ue.fov=Ir*2*Math.atan(1/ue.projectionMatrix.elements[5]),ue.zoom=1)}this.getCamera=function(){return ee},this.getFoveation=function(){if(!(g===null&&S===null))return d},this.setFoveation=function(ue){d=ue,g!==null&&(g.fixedFoveation=ue),S!==null&&S.fixedFoveation!==void 0&&(S.fixedFoveation=ue)},this.hasDepthSensing=function(){return x.texture!==null},this.getDepthSensingMesh=function(){return x.getMesh(ee)},this.getCameraTexture=function(ue){return y[ue]};let me=null;function Xe(ue,Fe){if(p=Fe.getViewerPose(f||c),w=Fe,p!==null){let Pe=p.views;S!==null&&(e.setRenderTargetFramebuffer(I,S.framebuffer),e.setRenderTarget(I));let je=!1;Pe.length!==ee.cameras.length&&(ee.cameras.length=0,je=!0);for(let et=0;et<Pe.length;et++){let wt=Pe[et],Tt=null;if(S!==null)Tt=S.getViewport(wt);else{let Vt=_.getViewSubImage(g,wt);Tt=Vt.viewport,et===0&&(e.setRenderTargetTextures(I,Vt.colorTexture,Vt.depthStencilTexture),e.setRenderTarget(I))}let dt=J[et];dt===void 0&&(dt=new gn,dt.layers.enable(et),dt.viewport=new zt,J[et]=dt),dt.matrix.fromArray(wt.transform.matrix),dt.matrix.decompose(dt.position,dt.quaternion,dt.scale),dt.projectionMatrix.fromArray(wt.projectionMatrix),dt.projectionMatrixInverse.copy(dt.projectionMatrix).invert(),dt.viewport.set(Tt.x,Tt.y,Tt.width,Tt.height),et===0&&(ee.matrix.copy(dt.matrix),ee.matrix.decompose(ee.position,ee.quaternion,ee.scale)),je===!0&&ee.cameras.push(dt)}let Ue=s.enabledFeatures;if(Ue&&Ue.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&R){_=n.getBinding();let et=_.getDepthInformation(Pe[0]);et&&et.isValid&&et.texture&&x.init(et,s.renderState)}if(Ue&&Ue.includes("camera-access")&&R){e.state.unbindTexture(),_=n.getBinding();for(let et=0;et<Pe.length;et++){let wt=Pe[et].camera;if(wt){let Tt=y[wt];Tt||(Tt=new xs,y[wt]=Tt);let dt=_.getCameraImage(wt);Tt.sourceTexture=dt}}}}for(let Pe=0;Pe<O.length;Pe++){let je=N[Pe],Ue=O[Pe];je!==null&&Ue!==void 0&&Ue.update(je,Fe,f||c)}me&&me(ue,Fe),Fe.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:Fe}),w=null}let nt=new Nd;nt.setAnimationLoop(Xe),this.setAnimationLoop=function(ue){me=ue},this.dispose=function(){}}},WM=new It,Xd=new at;Xd.set(-1,0,0,0,1,0,0,0,1);function XM(i,e){function t(x,y){x.matrixAutoUpdate===!0&&x.updateMatrix(),y.value.copy(x.matrix)}function n(x,y){y.color.getRGB(x.fogColor.value,Oc(i)),y.isFog?(x.fogNear.value=y.near,x.fogFar.value=y.far):y.isFogExp2&&(x.fogDensity.value=y.density)}function s(x,y,P,U,I){y.isNodeMaterial?y.uniformsNeedUpdate=!1:y.isMeshBasicMaterial?o(x,y):y.isMeshLambertMaterial?(o(x,y),y.envMap&&(x.envMapIntensity.value=y.envMapIntensity)):y.isMeshToonMaterial?(o(x,y),_(x,y)):y.isMeshPhongMaterial?(o(x,y),p(x,y),y.envMap&&(x.envMapIntensity.value=y.envMapIntensity)):y.isMeshStandardMaterial?(o(x,y),g(x,y),y.isMeshPhysicalMaterial&&S(x,y,I)):y.isMeshMatcapMaterial?(o(x,y),w(x,y)):y.isMeshDepthMaterial?o(x,y):y.isMeshDistanceMaterial?(o(x,y),R(x,y)):y.isMeshNormalMaterial?o(x,y):y.isLineBasicMaterial?(c(x,y),y.isLineDashedMaterial&&h(x,y)):y.isPointsMaterial?d(x,y,P,U):y.isSpriteMaterial?f(x,y):y.isShadowMaterial?(x.color.value.copy(y.color),x.opacity.value=y.opacity):y.isShaderMaterial&&(y.uniformsNeedUpdate=!1)}function o(x,y){x.opacity.value=y.opacity,y.color&&x.diffuse.value.copy(y.color),y.emissive&&x.emissive.value.copy(y.emissive).multiplyScalar(y.emissiveIntensity),y.map&&(x.map.value=y.map,t(y.map,x.mapTransform)),y.alphaMap&&(x.alphaMap.value=y.alphaMap,t(y.alphaMap,x.alphaMapTransform)),y.bumpMap&&(x.bumpMap.value=y.bumpMap,t(y.bumpMap,x.bumpMapTransform),x.bumpScale.value=y.bumpScale,y.side===yn&&(x.bumpScale.value*=-1)),y.normalMap&&(x.normalMap.value=y.normalMap,t(y.normalMap,x.normalMapTransform),x.normalScale.value.copy(y.normalScale),y.side===yn&&x.normalScale.value.negate()),y.displacementMap&&(x.displacementMap.value=y.displacementMap,t(y.displacementMap,x.displacementMapTransform),x.displacementScale.value=y.displacementScale,x.displacementBias.value=y.displacementBias),y.emissiveMap&&(x.emissiveMap.value=y.emissiveMap,t(y.emissiveMap,x.emissiveMapTransform)),y.specularMap&&(x.specularMap.value=y.specularMap,t(y.specularMap,x.specularMapTransform)),y.alphaTest>0&&(x.alphaTest.value=y.alphaTest);let P=e.get(y),U=P.envMap,I=P.envMapRotation;U&&(x.envMap.value=U,x.envMapRotation.value.setFromMatrix4(WM.makeRotationFromEuler(I)).transpose(),U.isCubeTexture&&U.isRenderTargetTexture===!1&&x.envMapRotation.value.premultiply(Xd),x.reflectivity.value=y.reflectivity,x.ior.value=y.ior,x.refractionRatio.value=y.refractionRatio),y.lightMap&&(x.lightMap.value=y.lightMap,x.lightMapIntensity.value=y.lightMapIntensity,t(y.lightMap,x.lightMapTransform)),y.aoMap&&(x.aoMap.value=y.aoMap,x.aoMapIntensity.value=y.aoMapIntensity,t(y.aoMap,x.aoMapTransform))}function c(x,y){x.diffuse.value.copy(y.color),x.opacity.value=y.opacity,y.map&&(x.map.value=y.map,t(y.map,x.mapTransform))}function h(x,y){x.dashSize.value=y.dashSize,x.totalSize.value=y.dashSize+y.gapSize,x.scale.value=y.scale}function d(x,y,P,U){x.diffuse.value.copy(y.color),x.opacity.value=y.opacity,x.size.value=y.size*P,x.scale.value=U*.5,y.map&&(x.map.value=y.map,t(y.map,x.uvTransform)),y.alphaMap&&(x.alphaMap.value=y.alphaMap,t(y.alphaMap,x.alphaMapTransform)),y.alphaTest>0&&(x.alphaTest.value=y.alphaTest)}function f(x,y){x.diffuse.value.copy(y.color),x.opacity.value=y.opacity,x.rotation.value=y.rotation,y.map&&(x.map.value=y.map,t(y.map,x.mapTransform)),y.alphaMap&&(x.alphaMap.value=y.alphaMap,t(y.alphaMap,x.alphaMapTransform)),y.alphaTest>0&&(x.alphaTest.value=y.alphaTest)}function p(x,y){x.specular.value.copy(y.specular),x.shininess.value=Math.max(y.shininess,1e-4)}function _(x,y){y.gradientMap&&(x.gradientMap.value=y.gradientMap)}function g(x,y){x.metalness.value=y.metalness,y.metalnessMap&&(x.metalnessMap.value=y.metalnessMap,t(y.metalnessMap,x.metalnessMapTransform)),x.roughness.value=y.roughness,y.roughnessMap&&(x.roughnessMap.value=y.roughnessMap,t(y.roughnessMap,x.roughnessMapTransform)),y.envMap&&(x.envMapIntensity.value=y.envMapIntensity)}function S(x,y,P){x.ior.value=y.ior,y.diffuseRoughness>0&&(x.diffuseRoughness.value=y.diffuseRoughness,y.diffuseRoughnessMap&&(x.diffuseRoughnessMap.value=y.diffuseRoughnessMap,t(y.diffuseRoughnessMap,x.diffuseRoughnessMapTransform))),y.sheen>0&&(x.sheenColor.value.copy(y.sheenColor).multiplyScalar(y.sheen),x.sheenRoughness.value=y.sheenRoughness,y.sheenColorMap&&(x.sheenColorMap.value=y.sheenColorMap,t(y.sheenColorMap,x.sheenColorMapTransform)),y.sheenRoughnessMap&&(x.sheenRoughnessMap.value=y.sheenRoughnessMap,t(y.sheenRoughnessMap,x.sheenRoughnessMapTransform))),y.clearcoat>0&&(x.clearcoat.value=y.clearcoat,x.clearcoatRoughness.value=y.clearcoatRoughness,y.clearcoatMap&&(x.clearcoatMap.value=y.clearcoatMap,t(y.clearcoatMap,x.clearcoatMapTransform)),y.clearcoatRoughnessMap&&(x.clearcoatRoughnessMap.value=y.clearcoatRoughnessMap,t(y.clearcoatRoughnessMap,x.clearcoatRoughnessMapTransform)),y.clearcoatNormalMap&&(x.clearcoatNormalMap.value=y.clearcoatNormalMap,t(y.clearcoatNormalMap,x.clearcoatNormalMapTransform),x.clearcoatNormalScale.value.copy(y.clearcoatNormalScale),y.side===yn&&x.clearcoatNormalScale.value.negate())),y.dispersion>0&&(x.dispersion.value=y.dispersion),y.retroreflectivity>0&&(x.retroreflectivity.value=y.retroreflectivity),y.iridescence>0&&(x.iridescence.value=y.iridescence,x.iridescenceIOR.value=y.iridescenceIOR,x.iridescenceThicknessMinimum.value=y.iridescenceThicknessMinimum,x.iridescenceThicknessMaximum.value=y.iridescenceThicknessMaximum,y.iridescenceMap&&(x.iridescenceMap.value=y.iridescenceMap,t(y.iridescenceMap,x.iridescenceMapTransform)),y.iridescenceThicknessMap&&(x.iridescenceThicknessMap.value=y.iridescenceThicknessMap,t(y.iridescenceThicknessMap,x.iridescenceThicknessMapTransform))),y.transmission>0&&(x.transmission.value=y.transmission,x.transmissionSamplerMap.value=P.texture,x.transmissionSamplerSize.value.set(P.width,P.height),y.transmissionMap&&(x.transmissionMap.value=y.transmissionMap,t(y.transmissionMap,x.transmissionMapTransform)),x.thickness.value=y.thickness,y.thicknessMap&&(x.thicknessMap.value=y.thicknessMap,t(y.thicknessMap,x.thicknessMapTransform)),x.attenuationDistance.value=y.attenuationDistance,x.attenuationColor.value.copy(y.attenuationColor)),y.anisotropy>0&&(x.anisotropyVector.value.set(y.anisotropy*Math.cos(y.anisotropyRotation),y.anisotropy*Math.sin(y.anisotropyRotation)),y.anisotropyMap&&(x.anisotropyMap.value=y.anisotropyMap,t(y.anisotropyMap,x.anisotropyMapTransform))),x.specularIntensity.value=y.specularIntensity,x.specularColor.value.copy(y.specularColor),y.specularColorMap&&(x.specularColorMap.value=y.specularColorMap,t(y.specularColorMap,x.specularColorMapTransform)),y.specularIntensityMap&&(x.specularIntensityMap.value=y.specularIntensityMap,t(y.specularIntensityMap,x.specularIntensityMapTransform))}function w(x,y){y.matcap&&(x.matcap.value=y.matcap)}function R(x,y){let P=e.get(y).light;x.referencePosition.value.setFromMatrixPosition(P.matrixWorld),x.nearDistance.value=P.shadow.camera.near,x.farDistance.value=P.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function $M(i,e,t,n){let s={},o={};function c(P,U){let I=U.program;n.uniformBlockBinding(P,I,s[P.id])}function h(P,U){let I=s[P.id];I===void 0&&(w(P),I=d(P),s[P.id]=I,P.addEventListener("dispose",x));let O=U.program;n.updateUBOMapping(P,O);let N=e.render.frame;o[P.id]!==N&&(f(P),o[P.id]=N)}function d(P){let U=i.createBuffer(),I=P.__size,O=P.usage;return i.bindBuffer(i.UNIFORM_BUFFER,U),i.bufferData(i.UNIFORM_BUFFER,I,O),i.bindBuffer(i.UNIFORM_BUFFER,null),U}function f(P){let U=s[P.id],I=P.uniforms,O=P.__cache;i.bindBuffer(i.UNIFORM_BUFFER,U);for(let N=0,b=I.length;N<b;N++){let L=I[N];if(Array.isArray(L))for(let q=0,k=L.length;q<k;q++)p(L[q],N,q,O);else p(L,N,0,O)}i.bindBuffer(i.UNIFORM_BUFFER,null)}function p(P,U,I,O){if(g(P,U,I,O)===!0){let N=P.__offset,b=P.value;if(Array.isArray(b)){let L=0;for(let q=0;q<b.length;q++){let k=b[q],Y=R(k,!0);_(k,P.__data,L),L+=Y.storage/Float32Array.BYTES_PER_ELEMENT}}else _(b,P.__data,0);i.bufferSubData(i.UNIFORM_BUFFER,N,P.__data)}}function _(P,U,I){typeof P=="number"||typeof P=="boolean"?U[I]=P:P.isMatrix3?(U[I]=P.elements[0],U[I+1]=P.elements[1],U[I+2]=P.elements[2],U[I+3]=0,U[I+4]=P.elements[3],U[I+5]=P.elements[4],U[I+6]=P.elements[5],U[I+7]=0,U[I+8]=P.elements[6],U[I+9]=P.elements[7],U[I+10]=P.elements[8],U[I+11]=0):ArrayBuffer.isView(P)?U.set(P.subarray(0,U.length-I),I):P.toArray(U,I)}function g(P,U,I,O){let N=P.value,b=U+"_"+I;if(Array.isArray(N)){O[b]===void 0&&(O[b]=[]);let L=O[b],q=!1;for(let k=0;k<N.length;k++)S(N[k],L,k)===!0&&(q=!0);return q}return S(N,O,b)}function S(P,U,I){if(U[I]===void 0)return typeof P=="number"||typeof P=="boolean"?U[I]=P:ArrayBuffer.isView(P)?U[I]=P.slice():U[I]=P.clone(),!0;{let O=U[I];if(typeof P=="number"||typeof P=="boolean"){if(O!==P)return U[I]=P,!0}else{if(ArrayBuffer.isView(P))return!0;if(O.equals(P)===!1)return O.copy(P),!0}}return!1}function w(P){let U=P.uniforms,I=0,O=16;for(let b=0,L=U.length;b<L;b++){let q=Array.isArray(U[b])?U[b]:[U[b]];for(let k=0,Y=q.length;k<Y;k++){let J=q[k],ee=Array.isArray(J.value)?J.value:[J.value],z=Array.isArray(U[b])||Array.isArray(J.value),ie=I;for(let ne=0,Se=ee.length;ne<Se;ne++){let re=ee[ne],H=R(re,z),me=I%O,Xe=me%H.boundary,nt=me+Xe;I+=Xe,nt!==0&&O-nt<H.storage&&(I+=O-nt),ne===0&&(ie=I),I+=H.storage}let G=J.type==="int"?Int32Array:J.type==="uint"?Uint32Array:Float32Array;J.__data=new G((I-ie)/Float32Array.BYTES_PER_ELEMENT),J.__offset=ie}}let N=I%O;return N>0&&(I+=O-N),P.__size=I,P.__cache={},this}function R(P,U){let I={boundary:0,storage:0};return typeof P=="number"||typeof P=="boolean"?(I.boundary=4,I.storage=4):P.isVector2?(I.boundary=8,I.storage=8):P.isVector3||P.isColor?(I.boundary=16,I.storage=12):P.isVector4?(I.boundary=16,I.storage=16):P.isMatrix3?(I.boundary=16,I.storage=48):P.isMatrix4?(I.boundary=16,I.storage=64):P.isTexture?Qe("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(P)?(I.boundary=16,I.storage=P.byteLength):Qe("WebGLRenderer: Unsupported uniform value type.",P),U===!0&&(I.boundary=16,I.storage=Math.ceil(I.storage/16)*16),I}function x(P){let U=P.target;U.removeEventListener("dispose",x),i.deleteBuffer(s[U.id]),delete s[U.id],delete o[U.id]}function y(){for(let P in s)i.deleteBuffer(s[P]);s={},o={}}return{bind:c,update:h,dispose:y}}var qM=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),ai=null;function YM(){return ai===null&&(ai=new ja(qM,16,16,Bi,Vn),ai.name="DFG_LUT",ai.minFilter=_n,ai.magFilter=_n,ai.wrapS=Qn,ai.wrapT=Qn,ai.generateMipmaps=!1,ai.needsUpdate=!0),ai}var sl=class{constructor(e={}){let{canvas:t=rd(),context:n=null,depth:s=!0,stencil:o=!1,alpha:c=!1,antialias:h=!1,premultipliedAlpha:d=!0,preserveDrawingBuffer:f=!1,powerPreference:p="default",failIfMajorPerformanceCaveat:_=!1,reversedDepthBuffer:g=!1,outputBufferType:S=Sn}=e;this.isWebGLRenderer=!0;let w;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");w=n.getContextAttributes().alpha}else w=c;let R=S,x=new Set([bo,Mo,So]),y=new Set([Sn,zn,Hr,ar,yo,xo]),P=new Uint32Array(4),U=new Int32Array(4),I={textures:[],min:[],max:[],resolution:[]},O=null,N=null,b=[],L=[],q=null;this.domElement=t,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=si,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let k=this,Y=!1,J=null,ee=null,z=null,ie=null;this._outputColorSpace=mn;let G=0,ne=0,Se=null,re=-1,H=null,me=new zt,Xe=new zt,nt=null,ue=new ut(0),Fe=0,Pe=t.width,je=t.height,Ue=1,rt=null,Gt=null,et=new zt(0,0,Pe,je),wt=new zt(0,0,Pe,je),Tt=!1,dt=new Li,Vt=new Ja,ht=!1,Rt=!1,St=new It,Qt=new Q,Le=new zt,qe={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},an=!1;function en(){return Se===null?Ue:1}let W=n;function fn(C,V){return t.getContext(C,V)}let At,Nt,De,Xt,Je,Ze,D,T,j,ve,de,pe,Me,ae,le,Ce,B,he,se,Re,Ee,Ae,$e;try{let C={alpha:!0,depth:s,stencil:o,antialias:h,premultipliedAlpha:d,preserveDrawingBuffer:f,powerPreference:p,failIfMajorPerformanceCaveat:_};if("setAttribute"in t&&t.setAttribute("data-engine",`three.js r${"187"}`),t.addEventListener("webglcontextlost",Ye,!1),t.addEventListener("webglcontextrestored",lt,!1),t.addEventListener("webglcontextcreationerror",Oe,!1),W===null){let V="webgl2";if(W=fn(V,C),W===null)throw fn(V)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}ot()}catch(C){throw t.removeEventListener("webglcontextlost",Ye,!1),t.removeEventListener("webglcontextrestored",lt,!1),t.removeEventListener("webglcontextcreationerror",Oe,!1),tt("WebGLRenderer: "+C.message),C}function ot(){At=new sS(W),At.init(),Ee=new GM(W,At),Nt=new Yx(W,At,e,Ee),De=new kM(W,At),Nt.reversedDepthBuffer&&g&&De.buffers.depth.setReversed(!0),ee=W.createFramebuffer(),z=W.createFramebuffer(),ie=W.createFramebuffer(),Xt=new lS(W),Je=new EM,Ze=new zM(W,At,De,Je,Nt,Ee,Xt),D=new rS(k),T=new hv(W),Ae=new $x(W,T),j=new aS(W,T,Xt,Ae),ve=new hS(W,j,T,Ae,Xt),he=new cS(W,Nt,Ze),le=new jx(Je),de=new wM(k,D,At,Nt,Ae,le),pe=new XM(k,Je),Me=new AM,ae=new DM(At),B=new Xx(k,D,De,ve,w,d),Ce=new BM(k,ve,Nt),$e=new $M(W,Xt,Nt,De),se=new qx(W,At,Xt),Re=new oS(W,At,Xt),Xt.programs=de.programs,k.capabilities=Nt,k.extensions=At,k.properties=Je,k.renderLists=Me,k.shadowMap=Ce,k.state=De,k.info=Xt}R!==Sn&&(q=new dS(R,t.width,t.height,h,s,o));let we=new Jc(k,W);this.xr=we,this.getContext=function(){return W},this.getContextAttributes=function(){return W.getContextAttributes()},this.forceContextLoss=function(){let C=At.get("WEBGL_lose_context");C&&C.loseContext()},this.forceContextRestore=function(){let C=At.get("WEBGL_lose_context");C&&C.restoreContext()},this.getPixelRatio=function(){return Ue},this.setPixelRatio=function(C){C!==void 0&&(Ue=C,this.setSize(Pe,je,!1))},this.getSize=function(C){return C.set(Pe,je)},this.setSize=function(C,V,te=!0){if(we.isPresenting){Qe("WebGLRenderer: Can't change size while VR device is presenting.");return}Pe=C,je=V,t.width=Math.floor(C*Ue),t.height=Math.floor(V*Ue),te===!0&&(t.style.width=C+"px",t.style.height=V+"px"),q!==null&&q.setSize(t.width,t.height),this.setViewport(0,0,C,V)},this.getDrawingBufferSize=function(C){return C.set(Pe*Ue,je*Ue).floor()},this.setDrawingBufferSize=function(C,V,te){Pe=C,je=V,Ue=te,t.width=Math.floor(C*te),t.height=Math.floor(V*te),this.setViewport(0,0,C,V)},this.setEffects=function(C){if(R===Sn){tt("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(C){for(let V=0;V<C.length;V++)if(C[V].isOutputPass===!0){Qe("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}q.setEffects(C||[])},this.getCurrentViewport=function(C){return C.copy(me)},this.getViewport=function(C){return C.copy(et)},this.setViewport=function(C,V,te,Z){C.isVector4?et.set(C.x,C.y,C.z,C.w):et.set(C,V,te,Z),De.viewport(me.copy(et).multiplyScalar(en()).round())},this.getScissor=function(C){return C.copy(wt)},this.setScissor=function(C,V,te,Z){C.isVector4?wt.set(C.x,C.y,C.z,C.w):wt.set(C,V,te,Z),De.scissor(Xe.copy(wt).multiplyScalar(en()).round())},this.getScissorTest=function(){return Tt},this.setScissorTest=function(C){De.setScissorTest(Tt=C)},this.setOpaqueSort=function(C){rt=C},this.setTransparentSort=function(C){Gt=C},this.getClearColor=function(C){return C.copy(B.getClearColor())},this.setClearColor=function(){B.setClearColor(...arguments)},this.getClearAlpha=function(){return B.getClearAlpha()},this.setClearAlpha=function(){B.setClearAlpha(...arguments)},this.clear=function(C=!0,V=!0,te=!0){let Z=0;if(C){let $=!1;if(Se!==null){let Ie=Se.texture.format;$=x.has(Ie)}if($){let Ie=Se.texture.type,Ge=y.has(Ie),Te=B.getClearColor(),Ne=B.getClearAlpha(),Ve=Te.r,it=Te.g,ft=Te.b;Ge?(P[0]=Ve,P[1]=it,P[2]=ft,P[3]=Ne,W.clearBufferuiv(W.COLOR,0,P)):(U[0]=Ve,U[1]=it,U[2]=ft,U[3]=Ne,W.clearBufferiv(W.COLOR,0,U))}else Z|=W.COLOR_BUFFER_BIT}V&&(Z|=W.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),te&&(Z|=W.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),Z!==0&&W.clear(Z)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(C){C.setRenderer(this),J=C},this.dispose=function(){t.removeEventListener("webglcontextlost",Ye,!1),t.removeEventListener("webglcontextrestored",lt,!1),t.removeEventListener("webglcontextcreationerror",Oe,!1),B.dispose(),Me.dispose(),ae.dispose(),Ze.dispose(),Je.dispose(),D.dispose(),ve.dispose(),j.dispose(),Ae.dispose(),$e.dispose(),de.dispose(),we.dispose(),we.removeEventListener("sessionstart",Yr),we.removeEventListener("sessionend",ci),on.stop()};function Ye(C){C.preventDefault(),Dc("WebGLRenderer: Context Lost."),Y=!0}function lt(){Dc("WebGLRenderer: Context Restored."),Y=!1;let C=Xt.autoReset,V=Ce.enabled,te=Ce.autoUpdate,Z=Ce.needsUpdate,$=Ce.type;ot(),Xt.autoReset=C,Ce.enabled=V,Ce.autoUpdate=te,Ce.needsUpdate=Z,Ce.type=$}function Oe(C){tt("WebGLRenderer: A WebGL context could not be created. Reason: ",C.statusMessage)}function Et(C){let V=C.target;V.removeEventListener("dispose",Et),Ot(V)}function Ot(C){li(C),Je.remove(C)}function li(C){let V=Je.get(C).programs;V!==void 0&&(V.forEach(function(te){de.releaseProgram(te)}),C.isShaderMaterial&&de.releaseShaderCache(C))}this.renderBufferDirect=function(C,V,te,Z,$,Ie){V===null&&(V=qe);let Ge=$.isMesh&&$.matrixWorld.determinantAffine()<0,Te=fl(C,V,te,Z,$);De.setMaterial(Z,Ge);let Ne=te.index,Ve=1;if(Z.wireframe===!0){if(Ne=j.getWireframeAttribute(te),Ne===void 0)return;Ve=2}let it=te.drawRange,ft=te.attributes.position,He=it.start*Ve,st=(it.start+it.count)*Ve;Ie!==null&&(He=Math.max(He,Ie.start*Ve),st=Math.min(st,(Ie.start+Ie.count)*Ve)),Ne!==null?(He=Math.max(He,0),st=Math.min(st,Ne.count)):ft!=null&&(He=Math.max(He,0),st=Math.min(st,ft.count));let Ht=st-He;if(Ht<0||Ht===1/0)return;Ae.setup($,Z,Te,te,Ne);let ke,Pt=se;if(Ne!==null&&(ke=T.get(Ne),Pt=Re,Pt.setIndex(ke)),$.isMesh)Z.wireframe===!0?(De.setLineWidth(Z.wireframeLinewidth*en()),Pt.setMode(W.LINES)):Pt.setMode(W.TRIANGLES);else if($.isLine){let qt=Z.linewidth;qt===void 0&&(qt=1),De.setLineWidth(qt*en()),$.isLineSegments?Pt.setMode(W.LINES):$.isLineLoop?Pt.setMode(W.LINE_LOOP):Pt.setMode(W.LINE_STRIP)}else $.isPoints?Pt.setMode(W.POINTS):$.isSprite&&Pt.setMode(W.TRIANGLES);if($.isBatchedMesh)if(At.get("WEBGL_multi_draw"))Pt.renderMultiDraw($._multiDrawStarts,$._multiDrawCounts,$._multiDrawCount);else{let qt=$._multiDrawStarts,We=$._multiDrawCounts,tn=$._multiDrawCount,Mt=Ne?T.get(Ne).bytesPerElement:1,Xn=Je.get(Z).currentProgram.getUniforms();for(let nn=0;nn<tn;nn++)Xn.setValue(W,"_gl_DrawID",nn),Pt.render(qt[nn]/Mt,We[nn])}else if($.isInstancedMesh)Pt.renderInstances(He,Ht,$.count);else if(te.isInstancedBufferGeometry){let qt=te._maxInstanceCount!==void 0?te._maxInstanceCount:1/0,We=Math.min(te.instanceCount,qt);Pt.renderInstances(He,Ht,We)}else Pt.render(He,Ht)};function ye(C,V,te,Z){J!==null&&C.isNodeMaterial&&J.setObject(Z,C),ht===!0&&le.setState(C,te,!1),C.transparent===!0&&C.side===ri&&C.forceSinglePass===!1?(C.side=yn,C.needsUpdate=!0,Gi(C,V,Z),C.side=Oi,C.needsUpdate=!0,Gi(C,V,Z),C.side=ri):Gi(C,V,Z)}this.compile=function(C,V,te=null){te===null&&(te=C),J!==null&&J.renderStart(C,V,te),N=ae.get(te),N.init(V),L.push(N),te.traverseVisible(function($){$.isLight&&$.layers.test(V.layers)&&(N.pushLight($),$.castShadow&&N.pushShadow($))}),C!==te&&C.traverseVisible(function($){$.isLight&&$.layers.test(V.layers)&&(N.pushLight($),$.castShadow&&N.pushShadow($))}),N.setupLights(),J!==null&&J.updateLights(N.state.lightsArray),Rt=this.localClippingEnabled,ht=le.init(this.clippingPlanes,Rt),ht===!0&&le.setGlobalState(this.clippingPlanes,V),J!==null&&Ce.render(N.state.shadowsArray,te,V);let Z=new Set;return C.traverse(function($){if(!($.isMesh||$.isPoints||$.isLine||$.isSprite))return;let Ie=$.material;if(Ie)if(Array.isArray(Ie))for(let Ge=0;Ge<Ie.length;Ge++){let Te=Ie[Ge];ye(Te,te,V,$),Z.add(Te)}else ye(Ie,te,V,$),Z.add(Ie)}),N=L.pop(),J!==null&&J.renderEnd(),Z},this.compileAsync=function(C,V,te=null){let Z=this.compile(C,V,te);return new Promise($=>{function Ie(){if(Z.forEach(function(Ge){let Ne=Je.get(Ge).currentProgram;(Ne===void 0||Ne.isReady())&&Z.delete(Ge)}),Z.size===0){$(C);return}setTimeout(Ie,10)}At.get("KHR_parallel_shader_compile")!==null?Ie():setTimeout(Ie,10)})};let ge=null;function Wn(C){ge&&ge(C)}function Yr(){on.stop()}function ci(){on.start()}let on=new Nd;on.setAnimationLoop(Wn),typeof self<"u"&&on.setContext(self),this.setAnimationLoop=function(C){ge=C,we.setAnimationLoop(C),C===null?on.stop():on.start()},we.addEventListener("sessionstart",Yr),we.addEventListener("sessionend",ci),this.render=function(C,V){if(V!==void 0&&V.isCamera!==!0){tt("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(Y===!0)return;J!==null&&J.renderStart(C,V);let te=we.enabled===!0&&we.isPresenting===!0,Z=q!==null&&(Se===null||te)&&q.begin(k,Se);if(C.matrixWorldAutoUpdate===!0&&C.updateMatrixWorld(),V.parent===null&&V.matrixWorldAutoUpdate===!0&&V.updateMatrixWorld(),we.enabled===!0&&we.isPresenting===!0&&(q===null||q.isCompositing()===!1)&&(we.cameraAutoUpdate===!0&&we.updateCamera(V),V=we.getCamera()),C.isScene===!0&&C.onBeforeRender(k,C,V,Se),N=ae.get(C,L.length),N.init(V),N.state.textureUnits=Ze.getTextureUnits(),L.push(N),St.multiplyMatrices(V.projectionMatrix,V.matrixWorldInverse),V.isArrayCamera?Vt.setFromArrayCamera(V):dt.setFromProjectionMatrix(St,In,V.reversedDepth),Rt=this.localClippingEnabled,ht=le.init(this.clippingPlanes,Rt),O=Me.get(C,b.length),O.init(),b.push(O),this.info.render.frame++,we.enabled===!0&&we.isPresenting===!0){let Ge=k.xr.getDepthSensingMesh();Ge!==null&&jr(Ge,V,-1/0,k.sortObjects)}jr(C,V,0,k.sortObjects),O.finish(),J!==null&&J.updateLights(N.state.lightsArray),k.sortObjects===!0&&O.sort(rt,Gt),an=we.enabled===!1||we.isPresenting===!1||we.hasDepthSensing()===!1,an&&B.addToRenderList(O,C),this.info.autoReset===!0&&this.info.reset(),ht===!0&&le.beginShadows();let $=N.state.shadowsArray;if(Ce.render($,C,V),ht===!0&&le.endShadows(),(Z&&q.hasRenderPass())===!1){let Ge=O.opaque,Te=O.transmissive;if(N.setupLights(),V.isArrayCamera){let Ne=V.cameras;if(Te.length>0)for(let Ve=0,it=Ne.length;Ve<it;Ve++){let ft=Ne[Ve];zi(Ge,Te,C,ft)}an&&B.render(C);for(let Ve=0,it=Ne.length;Ve<it;Ve++){let ft=Ne[Ve];An(O,C,ft,ft.viewport)}}else Te.length>0&&zi(Ge,Te,C,V),an&&B.render(C),An(O,C,V)}Se!==null&&ne===0&&(Ze.updateMultisampleRenderTarget(Se),Ze.updateRenderTargetMipmap(Se)),Z&&q.end(k),C.isScene===!0&&C.onAfterRender(k,C,V),Ae.resetDefaultState(),re=-1,H=null,L.pop(),L.length>0?(N=L[L.length-1],Ze.setTextureUnits(N.state.textureUnits),ht===!0&&le.setGlobalState(k.clippingPlanes,N.state.camera)):N=null,b.pop(),b.length>0?O=b[b.length-1]:O=null,J!==null&&J.renderEnd()};function jr(C,V,te,Z){if(C.visible===!1)return;if(C.layers.test(V.layers)){if(C.isGroup)te=C.renderOrder;else if(C.isLOD)C.autoUpdate===!0&&C.update(V);else if(C.isLight)N.pushLight(C),C.castShadow&&N.pushShadow(C);else if(C.isSprite){let Ge=V.isArrayCamera?Vt:dt;if(!C.frustumCulled||C.intersectsFrustum(Ge)){Z&&Le.setFromMatrixPosition(C.matrixWorld).applyMatrix4(St);let Te=ve.update(C),Ne=C.material;Ne.visible&&O.push(C,Te,Ne,te,Le.z,null,V)}}else if(C.isMesh||C.isLine||C.isPoints){let Ge=V.isArrayCamera?Vt:dt;if(!C.frustumCulled||C.intersectsFrustum(Ge)){let Te=ve.update(C),Ne=C.material;if(Z&&(C.boundingSphere!==void 0?(C.boundingSphere===null&&C.computeBoundingSphere(),Le.copy(C.boundingSphere.center)):(Te.boundingSphere===null&&Te.computeBoundingSphere(),Le.copy(Te.boundingSphere.center)),Le.applyMatrix4(C.matrixWorld).applyMatrix4(St)),Array.isArray(Ne)){let Ve=Te.groups;for(let it=0,ft=Ve.length;it<ft;it++){let He=Ve[it],st=Ne[He.materialIndex];st&&st.visible&&O.push(C,Te,st,te,Le.z,He,V)}}else Ne.visible&&O.push(C,Te,Ne,te,Le.z,null,V)}}}let Ie=C.children;for(let Ge=0,Te=Ie.length;Ge<Te;Ge++)jr(Ie[Ge],V,te,Z)}function An(C,V,te,Z){let{opaque:$,transmissive:Ie,transparent:Ge}=C;N.setupLightsView(te),ht===!0&&le.setGlobalState(k.clippingPlanes,te),Z&&De.viewport(me.copy(Z)),$.length>0&&cr($,V,te),Ie.length>0&&cr(Ie,V,te),Ge.length>0&&cr(Ge,V,te),De.buffers.depth.setTest(!0),De.buffers.depth.setMask(!0),De.buffers.color.setMask(!0),De.setPolygonOffset(!1)}function zi(C,V,te,Z){if((te.isScene===!0?te.overrideMaterial:null)!==null)return;if(N.state.transmissionRenderTarget[Z.id]===void 0){let He=At.has("EXT_color_buffer_half_float")||At.has("EXT_color_buffer_float");N.state.transmissionRenderTarget[Z.id]=new En(1,1,{generateMipmaps:!0,type:He?Vn:Sn,minFilter:xi,samples:Math.max(4,Nt.samples),stencilBuffer:o,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:yt.workingColorSpace})}let Ie=N.state.transmissionRenderTarget[Z.id],Ge=Z.viewport||me;Ie.setSize(Ge.z*k.transmissionResolutionScale,Ge.w*k.transmissionResolutionScale);let Te=k.getRenderTarget(),Ne=k.getActiveCubeFace(),Ve=k.getActiveMipmapLevel();k.setRenderTarget(Ie),k.getClearColor(ue),Fe=k.getClearAlpha(),Fe<1&&k.setClearColor(16777215,.5),k.clear(),an&&B.render(te);let it=k.toneMapping;k.toneMapping=si;let ft=Z.viewport;if(Z.viewport!==void 0&&(Z.viewport=void 0),N.setupLightsView(Z),ht===!0&&le.setGlobalState(k.clippingPlanes,Z),cr(C,te,Z),Ze.updateMultisampleRenderTarget(Ie),Ze.updateRenderTargetMipmap(Ie),At.has("WEBGL_multisampled_render_to_texture")===!1){let He=!1;for(let st=0,Ht=V.length;st<Ht;st++){let ke=V[st],{object:Pt,geometry:qt,material:We,group:tn}=ke;if(We.side===ri&&Pt.layers.test(Z.layers)){let Mt=We.side;We.side=yn,We.needsUpdate=!0,Xs(Pt,te,Z,qt,We,tn),We.side=Mt,We.needsUpdate=!0,He=!0}}He===!0&&(Ze.updateMultisampleRenderTarget(Ie),Ze.updateRenderTargetMipmap(Ie))}k.setRenderTarget(Te,Ne,Ve),k.setClearColor(ue,Fe),ft!==void 0&&(Z.viewport=ft),k.toneMapping=it}function cr(C,V,te){let Z=V.isScene===!0?V.overrideMaterial:null;for(let $=0,Ie=C.length;$<Ie;$++){let Ge=C[$],{object:Te,geometry:Ne,group:Ve}=Ge,it=Ge.material;it.allowOverride===!0&&Z!==null&&(it=Z),Te.layers.test(te.layers)&&Xs(Te,V,te,Ne,it,Ve)}}function Xs(C,V,te,Z,$,Ie){J!==null&&$.isNodeMaterial&&J.setObject(C,$),C.onBeforeRender(k,V,te,Z,$,Ie),C.modelViewMatrix.multiplyMatrices(te.matrixWorldInverse,C.matrixWorld),C.normalMatrix.getNormalMatrix(C.modelViewMatrix),$.onBeforeRender(k,V,te,Z,C,Ie),$.transparent===!0&&$.side===ri&&$.forceSinglePass===!1?($.side=yn,$.needsUpdate=!0,k.renderBufferDirect(te,V,Z,$,C,Ie),$.side=Oi,$.needsUpdate=!0,k.renderBufferDirect(te,V,Z,$,C,Ie),$.side=ri):k.renderBufferDirect(te,V,Z,$,C,Ie),C.onAfterRender(k,V,te,Z,$,Ie)}function Cn(C){let V=0;for(let te of C)te.texture!==null&&V++;return V}function Gi(C,V,te){V.isScene!==!0&&(V=qe);let Z=Je.get(C),$=N.state.lights,Ie=N.state.shadowsArray,Ge=$.state.version,Te=de.getParameters(C,$.state,Ie,V,te,N.state.lightProbeGridArray),Ne=de.getProgramCacheKey(Te),Ve=Z.programs;Z.environment=C.isMeshStandardMaterial||C.isMeshLambertMaterial||C.isMeshPhongMaterial?V.environment:null,Z.fog=V.fog;let it=C.isMeshStandardMaterial||C.isMeshLambertMaterial&&!C.envMap||C.isMeshPhongMaterial&&!C.envMap;Z.envMap=D.get(C.envMap||Z.environment,it),Z.envMapRotation=Z.environment!==null&&C.envMap===null?V.environmentRotation:C.envMapRotation,Ve===void 0&&(C.addEventListener("dispose",Et),Ve=new Map,Z.programs=Ve,Z.programVariants=new Map);let ft=Ve.get(Ne);if(ft!==void 0){if(Z.currentProgram===ft&&Z.lightsStateVersion===Ge)return ur(C,Te),ft}else Te.uniforms=de.getUniforms(C),J!==null&&C.isNodeMaterial&&J.build(C,te,Te),C.onBeforeCompile(Te,k),ft=de.acquireProgram(Te,Ne),Ve.set(Ne,ft),Z.uniforms=Te.uniforms;let He=Z.uniforms;return(!C.isShaderMaterial&&!C.isRawShaderMaterial||C.clipping===!0)&&(He.clippingPlanes=le.uniform),ur(C,Te),Z.needsLights=ml(C),Z.lightsStateVersion=Ge,Z.needsLights&&(He.ambientLightColor.value=$.state.ambient,He.lightProbe.value=$.state.probe,He.sunLights.value=$.state.sun,He.sunLightShadows.value=$.state.sunShadow,He.directionalLights.value=$.state.directional,He.directionalLightShadows.value=$.state.directionalShadow,He.spotLights.value=$.state.spot,He.spotLightShadows.value=$.state.spotShadow,He.rectAreaLights.value=$.state.rectArea,He.ltc_1.value=$.state.rectAreaLTC1,He.ltc_2.value=$.state.rectAreaLTC2,He.pointLights.value=$.state.point,He.pointLightShadows.value=$.state.pointShadow,He.hemisphereLights.value=$.state.hemi,He.sunShadowMatrix.value=$.state.sunShadowMatrix,He.sunShadowCascade.value=$.state.sunShadowCascade,He.directionalShadowMatrix.value=$.state.directionalShadowMatrix,He.spotLightMatrix.value=$.state.spotLightMatrix,He.spotLightMap.value=$.state.spotLightMap,He.pointShadowMatrix.value=$.state.pointShadowMatrix),Z.numLightProbeGrids=Cn(N.state.lightProbeGridArray),Z.currentProgram=ft,Z.uniformsList=null,ft}function hr(C,V,te,Z,$){let Ie=Je.get(C),Ge=Ie.currentProgram.id+","+Z+","+$,Te=Ie.programVariants.get(Ge);return Te===void 0?(Te=Gi(C,V,te),Ie.programVariants.set(Ge,Te)):(Ie.currentProgram=Te,Ie.uniformsList=null,Ie.outputColorSpace=Z,Ie.toneMapping=$),Te}function Vi(C){if(C.uniformsList===null){let V=C.currentProgram.getUniforms();C.uniformsList=Xr.seqWithValue(V.seq,C.uniforms)}return C.uniformsList}function ur(C,V){let te=Je.get(C);te.outputColorSpace=V.outputColorSpace,te.batching=V.batching,te.batchingColor=V.batchingColor,te.instancing=V.instancing,te.instancingColor=V.instancingColor,te.instancingMorph=V.instancingMorph,te.skinning=V.skinning,te.morphTargets=V.morphTargets,te.morphNormals=V.morphNormals,te.morphColors=V.morphColors,te.morphTargetsCount=V.morphTargetsCount,te.numClippingPlanes=V.numClippingPlanes,te.numIntersection=V.numClipIntersection,te.vertexAlphas=V.vertexAlphas,te.vertexTangents=V.vertexTangents,te.toneMapping=V.toneMapping}function fl(C,V,te,Z,$){V.isScene!==!0&&(V=qe),Ze.resetTextureUnits();let Ie=V.fog,Ge=Z.isMeshStandardMaterial||Z.isMeshLambertMaterial||Z.isMeshPhongMaterial?V.environment:null,Te=Se===null?k.outputColorSpace:Se.isXRRenderTarget===!0?Se.texture.colorSpace:yt.workingColorSpace,Ne=Z.isMeshStandardMaterial||Z.isMeshLambertMaterial&&!Z.envMap||Z.isMeshPhongMaterial&&!Z.envMap,Ve=D.get(Z.envMap||Ge,Ne),it=Z.vertexColors===!0&&!!te.attributes.color&&te.attributes.color.itemSize===4,ft=!!te.attributes.tangent&&(!!Z.normalMap||Z.anisotropy>0),He=!!te.morphAttributes.position,st=!!te.morphAttributes.normal,Ht=!!te.morphAttributes.color,ke=si;Z.toneMapped&&(Se===null||Se.isXRRenderTarget===!0)&&(ke=k.toneMapping);let Pt=te.morphAttributes.position||te.morphAttributes.normal||te.morphAttributes.color,qt=Pt!==void 0?Pt.length:0,We=Je.get(Z),tn=N.state.lights;if(ht===!0&&(Rt===!0||C!==H)){let Dt=C===H&&Z.id===re;le.setState(Z,C,Dt)}let Mt=!1,Xn=!1;Z.version===We.__version?We.needsLights&&We.lightsStateVersion!==tn.state.version||$.isBatchedMesh&&We.batching===!1||!$.isBatchedMesh&&We.batching===!0||$.isBatchedMesh&&We.batchingColor===!0&&$._colorsTexture===null||$.isBatchedMesh&&We.batchingColor===!1&&$._colorsTexture!==null||$.isInstancedMesh&&We.instancing===!1||!$.isInstancedMesh&&We.instancing===!0||$.isSkinnedMesh&&We.skinning===!1||!$.isSkinnedMesh&&We.skinning===!0||$.isInstancedMesh&&We.instancingColor===!0&&$.instanceColor===null||$.isInstancedMesh&&We.instancingColor===!1&&$.instanceColor!==null||$.isInstancedMesh&&We.instancingMorph===!0&&$.morphTexture===null||$.isInstancedMesh&&We.instancingMorph===!1&&$.morphTexture!==null||We.envMap!==Ve||Z.fog===!0&&We.fog!==Ie||We.numClippingPlanes!==void 0&&(We.numClippingPlanes!==le.numPlanes||We.numIntersection!==le.numIntersection)||We.vertexAlphas!==it||We.vertexTangents!==ft||We.morphTargets!==He||We.morphNormals!==st||We.morphColors!==Ht||We.morphTargetsCount!==qt||We.numLightProbeGrids!==Cn(N.state.lightProbeGridArray)?Mt=!0:(We.outputColorSpace!==Te||We.toneMapping!==ke)&&(Xn=!0):(Mt=!0,We.__version=Z.version);let nn=We.currentProgram;(Mt===!0||Xn===!0)&&(nn=Xn===!0?hr(Z,V,$,Te,ke):Gi(Z,V,$),J&&Z.isNodeMaterial&&J.onUpdateProgram(Z,nn,We));let bi=!1,$n=!1,qn=!1,M=nn.getUniforms(),ct=We.uniforms;if(De.useProgram(nn.program)&&(bi=!0,$n=!0,qn=!0),Z.id!==re&&(re=Z.id,$n=!0),bi||H!==C){De.buffers.depth.getReversed()&&C.reversedDepth!==!0&&(C._reversedDepth=!0,C.updateProjectionMatrix()),M.setValue(W,"projectionMatrix",C.projectionMatrix),M.setValue(W,"viewMatrix",C.matrixWorldInverse);let Bt=M.map.cameraPosition;Bt!==void 0&&Bt.setValue(W,Qt.setFromMatrixPosition(C.matrixWorld)),Nt.logarithmicDepthBuffer&&M.setValue(W,"logDepthBufFC",2/(Math.log(C.far+1)/Math.LN2)),(Z.isMeshPhongMaterial||Z.isMeshToonMaterial||Z.isMeshLambertMaterial||Z.isMeshBasicMaterial||Z.isMeshStandardMaterial||Z.isShaderMaterial)&&M.setValue(W,"isOrthographic",C.isOrthographicCamera===!0),H!==C&&(H=C,$n=!0,qn=!0)}if(We.needsLights&&(tn.state.sunShadowMap.length>0&&M.setValue(W,"sunShadowMap",tn.state.sunShadowMap,Ze),tn.state.directionalShadowMap.length>0&&M.setValue(W,"directionalShadowMap",tn.state.directionalShadowMap,Ze),tn.state.spotShadowMap.length>0&&M.setValue(W,"spotShadowMap",tn.state.spotShadowMap,Ze),tn.state.pointShadowMap.length>0&&M.setValue(W,"pointShadowMap",tn.state.pointShadowMap,Ze)),$.isSkinnedMesh){M.setOptional(W,$,"bindMatrix"),M.setOptional(W,$,"bindMatrixInverse");let Dt=$.skeleton;Dt&&(Dt.boneTexture===null&&Dt.computeBoneTexture(),M.setValue(W,"boneTexture",Dt.boneTexture,Ze))}$.isBatchedMesh&&(M.setOptional(W,$,"batchingTexture"),M.setValue(W,"batchingTexture",$._matricesTexture,Ze),M.setOptional(W,$,"batchingIdTexture"),M.setValue(W,"batchingIdTexture",$._indirectTexture,Ze),M.setOptional(W,$,"batchingColorTexture"),$._colorsTexture!==null&&M.setValue(W,"batchingColorTexture",$._colorsTexture,Ze));let Mn=te.morphAttributes;if((Mn.position!==void 0||Mn.normal!==void 0||Mn.color!==void 0)&&he.update($,te,nn),($n||We.receiveShadow!==$.receiveShadow)&&(We.receiveShadow=$.receiveShadow,M.setValue(W,"receiveShadow",$.receiveShadow)),(Z.isMeshStandardMaterial||Z.isMeshLambertMaterial||Z.isMeshPhongMaterial)&&Z.envMap===null&&V.environment!==null&&(ct.envMapIntensity.value=V.environmentIntensity),ct.dfgLUT!==void 0&&(ct.dfgLUT.value=YM()),$n){if(M.setValue(W,"toneMappingExposure",k.toneMappingExposure),We.needsLights&&pl(ct,qn),Ie&&Z.fog===!0&&pe.refreshFogUniforms(ct,Ie),pe.refreshMaterialUniforms(ct,Z,Ue,je,N.state.transmissionRenderTarget[C.id]),We.needsLights&&We.numLightProbeGrids>0){let Dt=I,Bt=0;for(let Dn of N.state.lightProbeGridArray)Dn.texture!==null&&(Dt.textures[Bt]=Dn.texture,Dt.min[Bt]=Dn.boundingBox.min,Dt.max[Bt]=Dn.boundingBox.max,Dt.resolution[Bt]=Dn.resolution,Bt++);for(let Dn in Dt)Dt[Dn].length=Bt;ct.probesSH.value=Dt.textures,ct.probesMin.value=Dt.min,ct.probesMax.value=Dt.max,ct.probesResolution.value=Dt.resolution}Xr.upload(W,Vi(We),ct,Ze)}if(Z.isShaderMaterial&&Z.uniformsNeedUpdate===!0&&(Xr.upload(W,Vi(We),ct,Ze),Z.uniformsNeedUpdate=!1),Z.isSpriteMaterial&&M.setValue(W,"center",$.center),M.setValue(W,"modelViewMatrix",$.modelViewMatrix),M.setValue(W,"normalMatrix",$.normalMatrix),M.setValue(W,"modelMatrix",$.matrixWorld),Z.uniformsGroups!==void 0){let Dt=Z.uniformsGroups;for(let Bt=0,Dn=Dt.length;Bt<Dn;Bt++){let $s=Dt[Bt];$e.update($s,nn),$e.bind($s,nn)}}return nn}function pl(C,V){C.ambientLightColor.needsUpdate=V,C.lightProbe.needsUpdate=V,C.sunLights.needsUpdate=V,C.sunLightShadows.needsUpdate=V,C.directionalLights.needsUpdate=V,C.directionalLightShadows.needsUpdate=V,C.pointLights.needsUpdate=V,C.pointLightShadows.needsUpdate=V,C.spotLights.needsUpdate=V,C.spotLightShadows.needsUpdate=V,C.rectAreaLights.needsUpdate=V,C.hemisphereLights.needsUpdate=V}function ml(C){return C.isMeshLambertMaterial||C.isMeshToonMaterial||C.isMeshPhongMaterial||C.isMeshStandardMaterial||C.isShadowMaterial||C.isShaderMaterial&&C.lights===!0}this.getActiveCubeFace=function(){return G},this.getActiveMipmapLevel=function(){return ne},this.getRenderTarget=function(){return Se},this.setRenderTargetTextures=function(C,V,te){let Z=Je.get(C);Z.__autoAllocateDepthBuffer=C.resolveDepthBuffer===!1,Z.__autoAllocateDepthBuffer===!1&&(Z.__useRenderToTexture=!1),Je.get(C.texture).__webglTexture=V,Je.get(C.depthTexture).__webglTexture=Z.__autoAllocateDepthBuffer?void 0:te,Z.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(C,V){let te=Je.get(C);te.__webglFramebuffer=V,te.__useDefaultFramebuffer=V===void 0},this.setRenderTarget=function(C,V=0,te=0){Se=C,G=V,ne=te;let Z=null,$=!1,Ie=!1;if(C){let Te=Je.get(C);if(Te.__useDefaultFramebuffer!==void 0){De.bindFramebuffer(W.FRAMEBUFFER,Te.__webglFramebuffer),me.copy(C.viewport),Xe.copy(C.scissor),nt=C.scissorTest,De.viewport(me),De.scissor(Xe),De.setScissorTest(nt),re=-1;return}else if(Te.__webglFramebuffer===void 0)Ze.setupRenderTarget(C);else if(Te.__hasExternalTextures)Ze.rebindTextures(C,Je.get(C.texture).__webglTexture,Je.get(C.depthTexture).__webglTexture);else if(C.depthBuffer){let it=C.depthTexture;if(Te.__boundDepthTexture!==it){if(it!==null&&Je.has(it)&&(C.width!==it.image.width||C.height!==it.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Ze.setupDepthRenderbuffer(C)}}let Ne=C.texture;(Ne.isData3DTexture||Ne.isDataArrayTexture||Ne.isCompressedArrayTexture)&&(Ie=!0);let Ve=Je.get(C).__webglFramebuffer;C.isWebGLCubeRenderTarget?(Array.isArray(Ve[V])?Z=Ve[V][te]:Z=Ve[V],$=!0):C.samples>0&&Ze.useMultisampledRTT(C)===!1?Z=Je.get(C).__webglMultisampledFramebuffer:Array.isArray(Ve)?Z=Ve[te]:Z=Ve,me.copy(C.viewport),Xe.copy(C.scissor),nt=C.scissorTest}else me.copy(et).multiplyScalar(Ue).floor(),Xe.copy(wt).multiplyScalar(Ue).floor(),nt=Tt;if(te!==0&&(Z=ee),De.bindFramebuffer(W.FRAMEBUFFER,Z)&&De.drawBuffers(C,Z),De.viewport(me),De.scissor(Xe),De.setScissorTest(nt),$){let Te=Je.get(C.texture);W.framebufferTexture2D(W.FRAMEBUFFER,W.COLOR_ATTACHMENT0,W.TEXTURE_CUBE_MAP_POSITIVE_X+V,Te.__webglTexture,te)}else if(Ie){let Te=V;for(let Ne=0;Ne<C.textures.length;Ne++){let Ve=Je.get(C.textures[Ne]);W.framebufferTextureLayer(W.FRAMEBUFFER,W.COLOR_ATTACHMENT0+Ne,Ve.__webglTexture,te,Te)}}else if(C!==null&&te!==0){let Te=Je.get(C.texture);W.framebufferTexture2D(W.FRAMEBUFFER,W.COLOR_ATTACHMENT0,W.TEXTURE_2D,Te.__webglTexture,te)}re=-1};function Jr(C){let V=Je.get(C);return(V.__readFormat!==C.format||V.__readType!==C.type)&&(V.__readFormat=C.format,V.__readType=C.type,V.__formatReadable=Nt.textureFormatReadable(C.format),V.__typeReadable=Nt.textureTypeReadable(C.type)),V}this.readRenderTargetPixels=function(C,V,te,Z,$,Ie,Ge,Te=0){if(!(C&&C.isWebGLRenderTarget)){tt("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let Ne=Je.get(C).__webglFramebuffer;if(C.isWebGLCubeRenderTarget&&Ge!==void 0&&(Ne=Ne[Ge],Array.isArray(Ne)&&(Ne=Ne[0])),Ne){De.bindFramebuffer(W.FRAMEBUFFER,Ne);try{let Ve=C.textures[Te],it=Ve.format,ft=Ve.type;C.textures.length>1&&W.readBuffer(W.COLOR_ATTACHMENT0+Te);let He=Jr(Ve);if(He.__formatReadable===!1){tt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(He.__typeReadable===!1){tt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}V>=0&&V<=C.width-Z&&te>=0&&te<=C.height-$&&W.readPixels(V,te,Z,$,Ee.convert(it),Ee.convert(ft),Ie)}finally{let Ve=Se!==null?Je.get(Se).__webglFramebuffer:null;De.bindFramebuffer(W.FRAMEBUFFER,Ve)}}},this.readRenderTargetPixelsAsync=async function(C,V,te,Z,$,Ie,Ge,Te=0){if(!(C&&C.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let Ne=Je.get(C).__webglFramebuffer;if(C.isWebGLCubeRenderTarget&&Ge!==void 0&&(Ne=Ne[Ge],Array.isArray(Ne)&&(Ne=Ne[0])),Ne)if(V>=0&&V<=C.width-Z&&te>=0&&te<=C.height-$){De.bindFramebuffer(W.FRAMEBUFFER,Ne);let Ve=C.textures[Te],it=Ve.format,ft=Ve.type;C.textures.length>1&&W.readBuffer(W.COLOR_ATTACHMENT0+Te);let He=Jr(Ve);if(He.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(He.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let st=W.createBuffer();W.bindBuffer(W.PIXEL_PACK_BUFFER,st),W.bufferData(W.PIXEL_PACK_BUFFER,Ie.byteLength,W.STREAM_READ),W.readPixels(V,te,Z,$,Ee.convert(it),Ee.convert(ft),0),W.bindBuffer(W.PIXEL_PACK_BUFFER,null);let Ht=Se!==null?Je.get(Se).__webglFramebuffer:null;De.bindFramebuffer(W.FRAMEBUFFER,Ht);let ke=W.fenceSync(W.SYNC_GPU_COMMANDS_COMPLETE,0);return W.flush(),await ad(W,ke,4),W.bindBuffer(W.PIXEL_PACK_BUFFER,st),W.getBufferSubData(W.PIXEL_PACK_BUFFER,0,Ie),W.bindBuffer(W.PIXEL_PACK_BUFFER,null),W.deleteBuffer(st),W.deleteSync(ke),Ie}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(C,V=null,te=0){let Z=Math.pow(2,-te),$=Math.floor(C.image.width*Z),Ie=Math.floor(C.image.height*Z),Ge=V!==null?V.x:0,Te=V!==null?V.y:0;Ze.setTexture2D(C,0),W.copyTexSubImage2D(W.TEXTURE_2D,te,0,0,Ge,Te,$,Ie),De.unbindTexture()},this.copyTextureToTexture=function(C,V,te=null,Z=null,$=0,Ie=0){let Ge,Te,Ne,Ve,it,ft,He,st,Ht,ke=C.isCompressedTexture?C.mipmaps[Ie]:C.image;if(te!==null)Ge=te.max.x-te.min.x,Te=te.max.y-te.min.y,Ne=te.isBox3?te.max.z-te.min.z:1,Ve=te.min.x,it=te.min.y,ft=te.isBox3?te.min.z:0;else{let M=Math.pow(2,-$);Ge=Math.floor(ke.width*M),Te=Math.floor(ke.height*M),C.isDataArrayTexture?Ne=ke.depth:C.isData3DTexture?Ne=Math.floor(ke.depth*M):Ne=1,Ve=0,it=0,ft=0}Z!==null?(He=Z.x,st=Z.y,Ht=Z.z):(He=0,st=0,Ht=0);let Pt=Ee.convert(V.format),qt=Ee.convert(V.type),We;V.isData3DTexture?(Ze.setTexture3D(V,0),We=W.TEXTURE_3D):V.isDataArrayTexture||V.isCompressedArrayTexture?(Ze.setTexture2DArray(V,0),We=W.TEXTURE_2D_ARRAY):(Ze.setTexture2D(V,0),We=W.TEXTURE_2D),De.activeTexture(W.TEXTURE0),De.pixelStorei(W.UNPACK_FLIP_Y_WEBGL,V.flipY),De.pixelStorei(W.UNPACK_PREMULTIPLY_ALPHA_WEBGL,V.premultiplyAlpha),De.pixelStorei(W.UNPACK_ALIGNMENT,V.unpackAlignment);let tn=De.getParameter(W.UNPACK_ROW_LENGTH),Mt=De.getParameter(W.UNPACK_IMAGE_HEIGHT),Xn=De.getParameter(W.UNPACK_SKIP_PIXELS),nn=De.getParameter(W.UNPACK_SKIP_ROWS),bi=De.getParameter(W.UNPACK_SKIP_IMAGES);De.pixelStorei(W.UNPACK_ROW_LENGTH,ke.width),De.pixelStorei(W.UNPACK_IMAGE_HEIGHT,ke.height),De.pixelStorei(W.UNPACK_SKIP_PIXELS,Ve),De.pixelStorei(W.UNPACK_SKIP_ROWS,it),De.pixelStorei(W.UNPACK_SKIP_IMAGES,ft);let $n=C.isDataArrayTexture||C.isData3DTexture,qn=V.isDataArrayTexture||V.isData3DTexture;if(C.isDepthTexture){let M=Je.get(C),ct=Je.get(V),Mn=Je.get(M.__renderTarget),Dt=Je.get(ct.__renderTarget);De.bindFramebuffer(W.READ_FRAMEBUFFER,Mn.__webglFramebuffer),De.bindFramebuffer(W.DRAW_FRAMEBUFFER,Dt.__webglFramebuffer);for(let Bt=0;Bt<Ne;Bt++)$n&&(W.framebufferTextureLayer(W.READ_FRAMEBUFFER,W.COLOR_ATTACHMENT0,Je.get(C).__webglTexture,$,ft+Bt),W.framebufferTextureLayer(W.DRAW_FRAMEBUFFER,W.COLOR_ATTACHMENT0,Je.get(V).__webglTexture,Ie,Ht+Bt)),W.blitFramebuffer(Ve,it,Ve+Ge,it+Te,He,st,He+Ge,st+Te,W.DEPTH_BUFFER_BIT,W.NEAREST);De.bindFramebuffer(W.READ_FRAMEBUFFER,null),De.bindFramebuffer(W.DRAW_FRAMEBUFFER,null)}else if($!==0||C.isRenderTargetTexture||Je.has(C)){let M=Je.get(C),ct=Je.get(V);De.bindFramebuffer(W.READ_FRAMEBUFFER,z),De.bindFramebuffer(W.DRAW_FRAMEBUFFER,ie);for(let Mn=0;Mn<Ne;Mn++)$n?W.framebufferTextureLayer(W.READ_FRAMEBUFFER,W.COLOR_ATTACHMENT0,M.__webglTexture,$,ft+Mn):W.framebufferTexture2D(W.READ_FRAMEBUFFER,W.COLOR_ATTACHMENT0,W.TEXTURE_2D,M.__webglTexture,$),qn?W.framebufferTextureLayer(W.DRAW_FRAMEBUFFER,W.COLOR_ATTACHMENT0,ct.__webglTexture,Ie,Ht+Mn):W.framebufferTexture2D(W.DRAW_FRAMEBUFFER,W.COLOR_ATTACHMENT0,W.TEXTURE_2D,ct.__webglTexture,Ie),$!==0?W.blitFramebuffer(Ve,it,Ve+Ge,it+Te,He,st,He+Ge,st+Te,W.COLOR_BUFFER_BIT,W.NEAREST):qn?W.copyTexSubImage3D(We,Ie,He,st,Ht+Mn,Ve,it,Ge,Te):W.copyTexSubImage2D(We,Ie,He,st,Ve,it,Ge,Te);De.bindFramebuffer(W.READ_FRAMEBUFFER,null),De.bindFramebuffer(W.DRAW_FRAMEBUFFER,null)}else qn?C.isDataTexture||C.isData3DTexture?W.texSubImage3D(We,Ie,He,st,Ht,Ge,Te,Ne,Pt,qt,ke.data):V.isCompressedArrayTexture?W.compressedTexSubImage3D(We,Ie,He,st,Ht,Ge,Te,Ne,Pt,ke.data):W.texSubImage3D(We,Ie,He,st,Ht,Ge,Te,Ne,Pt,qt,ke):C.isDataTexture?W.texSubImage2D(W.TEXTURE_2D,Ie,He,st,Ge,Te,Pt,qt,ke.data):C.isCompressedTexture?W.compressedTexSubImage2D(W.TEXTURE_2D,Ie,He,st,ke.width,ke.height,Pt,ke.data):W.texSubImage2D(W.TEXTURE_2D,Ie,He,st,Ge,Te,Pt,qt,ke);De.pixelStorei(W.UNPACK_ROW_LENGTH,tn),De.pixelStorei(W.UNPACK_IMAGE_HEIGHT,Mt),De.pixelStorei(W.UNPACK_SKIP_PIXELS,Xn),De.pixelStorei(W.UNPACK_SKIP_ROWS,nn),De.pixelStorei(W.UNPACK_SKIP_IMAGES,bi),Ie===0&&V.generateMipmaps===!0&&V.mipmapsAutoUpdate===!0&&W.generateMipmap(We),De.unbindTexture()},this.initRenderTarget=function(C){Je.get(C).__webglFramebuffer===void 0&&Ze.setupRenderTarget(C)},this.initTexture=function(C){C.isCubeTexture?Ze.setTextureCube(C,0):C.isData3DTexture?Ze.setTexture3D(C,0):C.isDataArrayTexture||C.isCompressedArrayTexture?Ze.setTexture2DArray(C,0):Ze.setTexture2D(C,0),De.unbindTexture()},this.resetState=function(){G=0,ne=0,Se=null,De.reset(),Ae.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return In}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(e){this._outputColorSpace=e;let t=this.getContext();t.drawingBufferColorSpace=yt._getDrawingBufferColorSpace(e),t.unpackColorSpace=yt._getUnpackColorSpace()}};var JM=4,$d={2:()=>new Or(1,48,32),3:([i,e])=>new Ss(i,2*e,12,32).rotateX(Math.PI/2),4:()=>new Or(1,48,32),5:()=>new Ms(1,1,2,48).rotateX(Math.PI/2),6:()=>new Di(2,2,2)},qd={2:([i])=>[i,i,i],3:()=>[1,1,1],4:i=>i,5:([i,e])=>[i,i,e],6:i=>i},Vs={background:"#f3f1ec",floor:"#f3f1ec",mat:"#fbfaf7",band:"#8a5a2f",mark:"#8d867a"},ll=class{constructor(e){this.renderer=new sl({canvas:e,antialias:!0}),this.renderer.shadowMap.enabled=!0,this.renderer.shadowMap.type=nr,this.camera=new gn(20,1,.05,30),this.camera.up.set(0,0,1)}build(e,t,n){Object.assign(this,{model:e,structure:t}),this.scene=new ps,this.scene.background=new ut(Vs.background),this.scene.add(new As("#ffffff","#d8d2c6",2),this.sun()),this.meshes=t.geoms.map((p,_)=>this.mesh(_)),this.meshes.filter(Boolean).forEach(p=>this.scene.add(p));let s=new vn().setFromPoints(n.map(p=>new Q(...p)));this.scene.add(new _s(s,new tr({color:Vs.mark})));let[o,c,h]=e.cam_pos,d=e.cam_mat0;new It().set(d[0],d[1],d[2],o,d[3],d[4],d[5],c,d[6],d[7],d[8],h,0,0,0,1).decompose(this.camera.position,this.camera.quaternion,new Q),this.fov=e.cam_fovy[0],this.bands=[]}sun(){let e=new Ps("#fff6e6",2.2);return e.position.set(-1.2,-1.6,3),e.castShadow=!0,e.shadow.mapSize.set(1024,1024),Object.assign(e.shadow.camera,{left:-1,right:1,top:1,bottom:-1,far:8}),e.shadow.bias=-.002,e}mesh(e){let{model:t,structure:n}=this,[s,o]=[e===n.floor[0],e===n.floor[1]],c=n.staged.includes(e),h=t.geom_group[e]===JM&&!c,d=t.geom_type[e];if(!(d in $d)||h&&!n.moving.includes(e))return null;let f=Array.from(t.geom_size.slice(3*e,3*e+3)),[p,_,g,S]=t.geom_rgba.slice(4*e,4*e+4),w=new ut().setRGB(p,_,g,mn);(s||o)&&w.set(s?Vs.floor:Vs.mat);let R=new ws({color:w,roughness:.62,transparent:S<1,opacity:S}),x=new Ln($d[d](f),R);return x.scale.set(...qd[d](f)),x.castShadow=!s&&!o,x.receiveShadow=!0,x.visible=c||!h&&n.placed.includes(e),x.userData={geom:e,kind:d,isGround:s||o},x}resize(e,t){this.renderer.setPixelRatio(Math.min(window.devicePixelRatio,2)),this.renderer.setSize(e,t,!1),this.camera.aspect=e/t;let n=Math.tan(tl.degToRad(this.fov/2))/Math.min(1,this.camera.aspect);this.camera.fov=tl.radToDeg(2*Math.atan(n)),this.camera.updateProjectionMatrix()}show({positions:e,rotations:t,sizes:n}){let s=new It;this.meshes.forEach((o,c)=>{if(!o)return;let h=t.slice(9*c,9*c+9);s.set(h[0],h[1],h[2],0,h[3],h[4],h[5],0,h[6],h[7],h[8],0,0,0,0,1),o.quaternion.setFromRotationMatrix(s),o.position.fromArray(e,3*c),n[c]&&o.scale.set(...qd[o.userData.kind](n[c]))});for(let{line:o,ends:c}of this.bands)o.geometry.setFromPoints(c.map(h=>h.position))}draw(){this.renderer.render(this.scene,this.camera)}dropShadows(){this.renderer.shadowMap.enabled=!1,this.meshes.filter(Boolean).forEach(e=>e.material.needsUpdate=!0)}reveal(e){let t=this.meshes.filter(s=>s&&!s.visible),n=this.meshes.filter(s=>s?.visible&&!s.userData.isGround);this.scene.updateMatrixWorld(!0);for(let{position:s}of t){let o=s.distanceTo(this.camera.position),c=s.clone().sub(this.camera.position).normalize();for(let h of new kr(this.camera.position,c,0,o).intersectObjects(n))Object.assign(h.object.material,{transparent:!0,opacity:.25,depthWrite:!1,needsUpdate:!0}),h.object.castShadow=!1}t.forEach(s=>s.visible=!0);for(let s of e){let o=s.map(h=>this.find(h)),c=new Ur(new vn,new tr({color:Vs.band}));c.material.depthTest=!1,this.bands.push({line:c,ends:o}),this.scene.add(c)}}find(e){let t=this.meshes.filter(n=>n&&this.structure.things[n.userData.geom]===e);return t.find(n=>n.visible)??t[0]}locate(e,t=0){let n=this.find(e);if(!n)return null;let s=n.position.clone();return s.z+=t*n.scale.z,this.project(s)}project(e){let{x:t,y:n}=new Q(...e).project(this.camera);return[(t+1)/2,(1-n)/2]}isBelow(e){let{position:t,scale:n}=this.find(e);return t.z+n.z<=0}pick(e,t){let n=new kr;n.setFromCamera(new gt(2*e-1,1-2*t),this.camera);let s=n.intersectObjects(this.meshes.filter(o=>o?.visible))[0];return s?this.structure.things[s.object.userData.geom]:null}};var ZM=i=>typeof i=="bigint"?BigInt.asUintN(64,i):i,Lt=i=>(...e)=>{let t=Math.max(...e.map(n=>n.length));return Array.from({length:t},(n,s)=>ZM(i(...e.map(o=>o.length===1?o[0]:o[s]))))},KM=i=>{let e=Math.round(i);return Math.abs(i%1)===.5&&e%2!==0?e-1:e},QM={absolute:Lt(Math.abs),add:Lt((i,e)=>i+e),any:i=>[+i.some(Boolean)],bitwise_and:Lt((i,e)=>i&e),bitwise_or:Lt((i,e)=>i|e),bitwise_xor:Lt((i,e)=>i^e),clip:Lt((i,e,t)=>Math.min(Math.max(i,e),t)),concatenate:(...i)=>i.flat(),divide:Lt((i,e)=>i/e),equal:Lt((i,e)=>+(i===e)),floor:Lt(Math.floor),floor_divide:Lt((i,e)=>Math.floor(i/e)),from_uint64:Lt(Number),greater:Lt((i,e)=>+(i>e)),greater_equal:Lt((i,e)=>+(i>=e)),left_shift:Lt((i,e)=>i<<e),less:Lt((i,e)=>+(i<e)),less_equal:Lt((i,e)=>+(i<=e)),max:i=>[Math.max(...i)],maximum:Lt(Math.max),minimum:Lt(Math.min),multiply:Lt((i,e)=>i*e),negative:Lt(i=>-i),not_equal:Lt((i,e)=>+(i!==e)),right_shift:Lt((i,e)=>i>>e),rint:Lt(KM),row:(i,[e])=>i[e],sign:Lt(i=>(i>0)-(i<0)),slice:(i,[e],[t])=>i.slice(e,t),sqrt:Lt(Math.sqrt),subtract:Lt((i,e)=>i-e),sum:i=>[i.reduce((e,t)=>e+t,0)],to_uint64:Lt(BigInt),trunc:Lt(Math.trunc),where:Lt((i,e,t)=>i?e:t)};function lr(i,e){if(typeof i=="number")return[i];if(typeof i=="string")return e[i];let[t,...n]=i;return t==="uint64"?n.map(BigInt):typeof t!="string"?i:QM[t](...n.map(s=>lr(s,e)))}function Hs(i,e,t){let[n,s,o]=[0,0,!1];return{rewards:t.map((h,d)=>{let f=h-i.interactions.length,p=f===e.answers[n];f>=0&&(n+=1);let _=i.num_questions-n;o=_===0||d+1>=i.step_limit;let g=(f<0?0:p?1:-1)-(o?_:0);return s+=g*i.discount**d,g}),over:o,earned:s,answered:n}}var Ws=class{constructor(e,t){Object.assign(this,{mujoco:e,task:t,compiled:null})}compile(e){if(this.compiled!==e){for(let t of[this.drawn,this.data,this.model])t?.delete();this.model=this.mujoco.MjModel.from_xml_string(this.task.structures[e].xml),this.data=new this.mujoco.MjData(this.model),this.drawn=new this.mujoco.MjData(this.model),this.compiled=e}}reset(e){let t=this.task.instances[e],n=this.task.structures[t.structure];Object.assign(this,{place:e,instance:t,structure:n}),this.compile(t.structure);for(let[s,o,c]of t.fields){let h=this.model[s];o.forEach((d,f)=>h[d]=c[f])}return this.start=t.start??n.start,this.mujoco.mj_resetData(this.model,this.data),this.data.qpos.set(this.start.qpos),this.touched=n.held.map(()=>!1),this.actions=[],this.judged=Hs(this.task,t,[]),this.measured=this.start.sensordata.slice(),this.observation=this.look()}step(e){let t=e>=this.task.interactions.length;return this.actions.push(e),t||this.interact(e),this.judged=Hs(this.task,this.instance,this.actions),(!t||!this.judged.over)&&(this.observation=this.look()),this.observation}interact(e){let{mujoco:t,model:n,data:s,task:o,instance:c}=this,h={actions:[e],qpos:Array.from(s.qpos),ctrl:Array.from(s.ctrl),controls:o.controls},d=c.strength;lr(o.drive,h).forEach((f,p)=>{s.ctrl[p]=f*(d.length===1?d[0]:d[p])});for(let f=0;f<c.substeps;f++)t.mj_step(n,s);t.mj_fwdPosition(n,s),t.mj_sensorPos(n,s),this.measured=Array.from(s.sensordata),this.structure.held.forEach((f,p)=>{let _=g=>Math.abs(s.qpos[g]-this.start.qpos[g])>o.tolerance;if(f.qpos.some(_)&&(this.touched[p]=!0),!this.touched[p])for(let g of f.sensordata)this.measured[g]=this.start.sensordata[g]})}look(){let{task:e,instance:t,structure:n,actions:s}=this,o=Math.min(this.judged.answered,e.num_questions-1);n.told.forEach((h,d)=>this.measured[h]=t.told[o][s.length][d]);let c=t.noise?.[s.length]??{};return Object.fromEntries(Object.keys(e.readings).map(h=>{let d=Float32Array.from(this.read(h,this.measured));return c[h]?.forEach((f,p)=>d[p]+=f),[h,d]}))}read(e,t){let n=this.structure.addresses[e].map(o=>t[o]),{measure:s}=this.task.readings[e];return s?lr(s,{sensors:n}):n}placed(e){let{mujoco:t,model:n,drawn:s,structure:o,task:c}=this;s.qpos.set(n.qpos0);for(let[p,_,g]of o.joints)s.qpos[p]=e[_][g];t.mj_kinematics(n,s);let h=Yd(s),d=o.start,f=(p,_)=>e[p][_]-this.read(p,d.sensordata)[_];for(let[p,_,g]of o.displaced)g.forEach((S,w)=>h.positions[3*p+w]=d.geom_xpos[3*p+w]+f(_,S));return o.indicators.forEach(([p,_,g,S],w)=>{S.forEach((R,x)=>{h.positions[3*p+x]=d.geom_xpos[3*p+x]+R*f(_,g)}),c.sizes[w]&&(h.sizes[p]=lr(c.sizes[w],{value:[e[_][g]]}))}),o.staged.forEach((p,_)=>{let[g,S]=c.moves[_];g&&(h.positions[3*p+2]+=lr(g,e)[0]),S&&h.rotations.splice(9*p,9,...eb(h.rotations.slice(9*p,9*p+9),lr(S,e)[0]))}),h}truth(e=null){let{mujoco:t,model:n,data:s,drawn:o,structure:c}=this,h=this.placed(this.observation);e?o.qpos.set(e):o.qpos.set(s.qpos),t.mj_kinematics(n,o);let d={...Yd(o),sizes:h.sizes},f=(p,_,g)=>{for(let S=g*_;S<g*(_+1);S++)d[p][S]=h[p][S]};for(let[p]of c.indicators)this.isSimulated(p)||f("positions",p,3);for(let p of c.staged)f("positions",p,3),f("rotations",p,9);return d}isSimulated(e){return this.model.body_weldid[this.model.geom_bodyid[e]]!==0}},eb=(i,e)=>{let[t,n]=[Math.cos(e),Math.sin(e)],s=(o,c,h)=>[0,1,2].map(d=>o*i[d]+c*i[6+d]+h*i[3+d]);return[...s(t,n,0),...s(0,0,1),...s(-n,t,0)]},Yd=i=>({positions:Array.from(i.geom_xpos),rotations:Array.from(i.geom_xmat),sizes:{}});var tb=450,nb=40,ib=80,Zc="1234567890qwertyuiopasdfghjklzxcvbnm",rb=12,sb=.02,ab=6,ze=(i,e={},...t)=>{let n=Object.assign(document.createElement(i),e);return n.append(...t),n},qr=i=>i.replaceAll("_"," "),jd=(i,{unit:e})=>e?`${qr(i)}, ${e}`:qr(i),Kc=i=>String(+i.toFixed(3)||0),cl=i=>i.toFixed(2).replace("-","\u2212"),ob=()=>new Promise(i=>requestAnimationFrame(i)),hl=class{constructor(e,t,n,{onEnd:s=()=>{},next:o=null,judge:c=null}={}){Object.assign(this,{root:e,task:n,onEnd:s,next:o,judge:c,world:new Ws(t,n)});let h=(d,f="section")=>this[d]=ze(f,{className:d});this.canvas=ze("canvas"),e.replaceChildren(ze("header",{},ze("h1",{textContent:n.question}),h("price","div")),ze("div",{className:"stage"},this.canvas,h("marks","div")),ze("aside",{},h("result"),h("experiments"),h("answers"),h("seen"),this.about())),this.result.setAttribute("aria-live","polite"),this.scene=new ll(this.canvas),this.observer=new ResizeObserver(()=>this.resize()),this.observer.observe(this.canvas.parentElement),this.canvas.onclick=d=>this.click(d),this.onKey=d=>this.key(d),window.addEventListener("keydown",this.onKey)}about(){let e=ze("summary",{textContent:"What is on the table"});return ze("section",{},ze("details",{},e,ze("p",{textContent:this.task.description})))}close(){window.removeEventListener("keydown",this.onKey),this.observer.disconnect(),this.scene.renderer.dispose()}begin(e,t=!1){this.isReplay=t;let n=this.world.reset(e);this.seenSoFar=[n],this.times=[],this.isBusy=!1,this.scales=Yh(this.task,this.world);let s=this.scales.flatMap(o=>o.lines);this.scene.build(this.world.model,this.world.structure,s),this.pose=this.world.placed(n),this.names(),this.resize(),this.result.hidden=!0,this.experiments.hidden=this.answers.hidden=!1,this.buttons(),this.tell(),this.readyAt=performance.now()}get isOver(){return this.world.judged.over}async act(e){if(this.isBusy||this.isOver)return;this.isBusy=!0,this.times.push(Math.round(performance.now()-this.readyAt)),this.menu?.remove();let t=this.seenSoFar.at(-1),n=this.world.step(e);this.seenSoFar.push(n),this.buttons(),this.tell(),await this.move(t,n),this.isBusy=!1,this.readyAt=performance.now(),this.isOver?await this.end():this.buttons()}async move(e,t){let n=Object.keys(t).filter(h=>t[h].some((d,f)=>d!==e[h][f])),s=performance.now(),[o,c]=[n.length?0:1,0];for(;o<1;){await ob(),c+=1,o=Math.min(1,(performance.now()-s)/tb);let h=o*o*(3-2*o),d=f=>Array.from(e[f],(p,_)=>p+h*(t[f][_]-p));this.pose=this.world.placed({...t,...Object.fromEntries(n.map(f=>[f,d(f)]))}),this.draw()}c&&(performance.now()-s)/c>ib&&this.scene.dropShadows()}async end(){let{world:e,task:t}=this;this.scene.reveal(e.instance.tied),this.pose=e.truth(),this.show(),this.onEnd(this.record());let n=e.actions.at(-1)-t.interactions.length;for(let s of n>=0&&t.played_out[e.place]?.[n]||[]){if(await new Promise(o=>setTimeout(o,nb)),e.judged.over===!1)return;this.pose=e.truth(s),this.draw()}}record(){let{task:e,world:t,times:n}=this;return{task:e.name,seed:e.seed,episode:t.instance.episode,actions:[...t.actions],times:[...n]}}resize(){let{clientWidth:e,clientHeight:t}=this.canvas.parentElement;!this.pose||!e||(this.scene.resize(e,t),this.draw())}draw(){this.scene.show(this.pose),this.scene.draw();for(let{node:e,thing:t,above:n,at:s}of this.labels){let[o,c]=s?this.scene.project(s):this.scene.locate(t,n);Object.assign(e.style,{left:`${100*o}%`,top:`${100*c}%`}),e.hidden=!s&&this.scene.isBelow(t)}}names(){let{task:e,world:t,scene:n}=this,s=[...new Set(e.interactions.map(({thing:p})=>p))],o=Object.groupBy(t.structure.indicators,([,p])=>p),c=t.structure.indicators.filter(([p,_])=>!s.includes(t.structure.things[p])&&o[_].length<=ab).map(([p,_,g])=>({thing:t.structure.things[p],text:o[_].length>1?`${qr(_)} ${g}`:qr(_)})),h=[...s.map(p=>({thing:p,text:qr(p),isName:!0})),...c],d=new Set;this.labels=h.filter(({thing:p,text:_})=>n.find(p)&&!d.has(_)&&d.add(_)).map(({thing:p,text:_,isName:g})=>({thing:p,above:g?0:1,node:this.mark(_,g,p)}));let f=(p,_,g)=>this.labels.push({at:p,node:ze("span",{className:_,textContent:g})});for(let{name:p,thing:_,lines:g,numbers:S}of this.scales){s.includes(_)&&f(g[0],"number caption",qr(p));for(let{value:w,at:R}of S)f(R,"number",Kc(w).replace("-","\u2212"))}t.structure.staged.forEach((p,_)=>{let[g,S,w]=t.structure.start.geom_xpos.slice(3*p,3*p+3);e.texts[_]&&f([g,S-t.model.geom_size[3*p+1]-sb,w],"number",e.texts[_])}),this.marks.replaceChildren(...this.labels.map(({node:p})=>p))}mark(e,t,n){return t?ze("button",{className:"name",textContent:e,tabIndex:-1,onclick:s=>this.choose(n,s)}):ze("span",{className:"board",textContent:e})}click(e){let t=this.canvas.getBoundingClientRect();this.choose(this.scene.pick((e.clientX-t.left)/t.width,(e.clientY-t.top)/t.height),e)}choose(e,t){this.menu?.remove();let n=this.task.interactions.flatMap((h,d)=>h.thing===e?[d]:[]);if(this.isBusy||this.isOver||!n.length)return;if(n.length===1)return this.act(n[0]);let s=this.canvas.getBoundingClientRect();this.menu=ze("div",{className:"menu"},...n.map(h=>this.button(h,this.task.actions[h])));let[o,c]=[(t.clientX-s.left)/s.width,(t.clientY-s.top)/s.height];Object.assign(this.menu.style,{[o>.6?"right":"left"]:`${100*(o>.6?1-o:o)}%`}),Object.assign(this.menu.style,{[c>.5?"bottom":"top"]:`${100*(c>.5?1-c:c)}%`}),this.marks.append(this.menu)}key(e){if(e.ctrlKey||e.metaKey||e.altKey||e.target.matches?.("select, input"))return;let t=Zc.indexOf(e.key);e.key==="Escape"?this.menu?.remove():t>=0&&t<this.task.actions.length?this.act(t):e.key==="Enter"&&this.isOver&&e.target.tagName!=="BUTTON"&&this.next?.()}button(e,t){let n=Zc[e]?[ze("kbd",{textContent:Zc[e]})]:[],s=ze("button",{title:this.task.actions[e],onclick:()=>this.act(e)},t,...n);return s.dataset.action=e,s.disabled=this.isBusy||this.isOver,s}buttons(){let{task:e}=this,t=e.interactions.length,n=document.activeElement?.dataset?.action,s=Object.values(Object.groupBy(e.interactions.keys(),p=>e.interactions[p].thing)),o=s.map(p=>this.row(p.map(_=>[_,e.actions[_]]))),c=s.every(p=>p.length===1),h=()=>[ze("div",{className:"row"},...o.flatMap(p=>[...p.children]))];this.experiments.replaceChildren(ze("h2",{textContent:"Experiment"}),...c?h():o);let d=e.labels.map((p,_)=>[t+_,p]),f=`Or answer${e.num_questions>1?` question ${this.world.judged.answered+1} of ${e.num_questions}`:""}`;this.answers.replaceChildren(ze("h2",{textContent:f}),this.row(d,!1)),n!==void 0&&this.root.querySelector(`[data-action="${n}"]`)?.focus({preventScroll:!0})}row(e,t=e.length>1){let n=e.map(([,d])=>d.split(" ")),s=d=>n.every(f=>f.length>d+1&&f[d]===n[0][d]),o=0;for(;t&&s(o);)o+=1;let c=n[0].slice(0,o).join(" "),h=e.map(([d],f)=>this.button(d,n[f].slice(o).join(" ")));return ze("div",{className:"row"},...c?[ze("span",{textContent:c})]:[],...h)}tell(){let{task:e,world:t}=this,n=this.isOver?t.judged.earned:e.discount**t.actions.length,s=e.step_limit-t.actions.length,o=ze("i");o.style.setProperty("--worth",Math.max(0,n));let c=this.isOver?"earned":`worth now \xB7 ${s} move${s===1?"":"s"} left`;this.price.replaceChildren(ze("b",{textContent:cl(n)}),ze("small",{textContent:c}),o);let h=this.table(),d=h.querySelectorAll("thead tr:last-child th").length>rb,f=this.seen.querySelector("details")?.open??!1,p=ze("summary",{textContent:"all numbers"});this.seen.replaceChildren(ze("h2",{textContent:"Seen"}),ze("div",{className:"plots"},...Wh(e,this.seenSoFar).map(_=>this.plot(_))),d?ze("details",{open:f},p,h):h),this.seen.scrollTop=this.seen.scrollHeight}plot(e){let t=this.task.readings[e],n=jd(e,t),s=this.seenSoFar.map(o=>Array.from(o[e]));return ze("figure",{title:t.meaning},ze("figcaption",{textContent:n}),Xh(n,t,s,Kc))}table(){let{task:e,world:t,seenSoFar:n}=this,s=Object.entries(e.readings).flatMap(([f,p])=>p.names.flatMap((_,g)=>p.components.map((S,w)=>({name:f,place:g*p.components.length+w,title:p.names.length*p.components.length>1?`${_} ${S}`.trim():"",limits:p.limits?.[w]})))),o=Object.entries(e.readings).map(([f,p])=>ze("th",{colSpan:p.names.length*p.components.length,title:p.meaning,textContent:jd(f,p)})),c=(f,{name:p,place:_,limits:g})=>{let S=f[p][_],w=ze("td",{textContent:Kc(S)});return g&&w.style.setProperty("--fill",Math.min(1,Math.abs(S)/Math.max(...g.map(Math.abs)))),w},h=t.judged.rewards,d=f=>{if(f===0)return"at first";let p=t.actions[f-1];return p<e.interactions.length?e.actions[p]:`${e.actions[p]} ${h[f-1]>0?"\u2713":"\u2717"}`};return ze("table",{},ze("thead",{},ze("tr",{},ze("th"),...o),ze("tr",{},ze("th"),...s.map(({title:f})=>ze("th",{textContent:f})))),ze("tbody",{},...n.map((f,p)=>ze("tr",{},ze("th",{textContent:d(p)}),...s.map(_=>c(f,_))))))}show(){let{task:e,world:t}=this,{instance:n,actions:s,judged:o}=t,c=e.interactions.length,h=(R,x)=>{let y=Hs(e,n,x),P=(U,I)=>{let O=U<c?"":y.rewards[I]>0?"right":"wrong",N={right:" \u2713",wrong:" \u2717"}[O]??"";return ze("span",{className:O,textContent:e.actions[U].replace("answer: ","")+N})};return ze("tr",{},ze("th",{textContent:R}),ze("td",{},...x.map(P)),ze("td",{textContent:cl(y.earned)}))},d=n.answers.map(R=>e.labels[R]).join(", "),f=o.rewards.filter(R=>R>0).length,p=f===e.num_questions,_=e.num_questions>1?`${f} of ${e.num_questions} right`:p?"Right":"Wrong",g=this.next&&ze("button",{className:"next",textContent:"Next",onclick:()=>this.next()}),S=ze("div",{className:"mistakes"});this.judge&&this.tellMistakes(S);let w=Object.entries(n.others??{}).map(([R,x])=>h(R,x));this.result.replaceChildren(ze("h2",{className:p?"right":"wrong",textContent:`${p?"\u2713":"\u2717"} ${_}: ${d}`}),ze("p",{textContent:`${this.isReplay?"It earns":"You earn"} ${cl(o.earned)}.`}),ze("table",{},h(this.isReplay?"replay":"you",s),...w),S,...g?[g]:[]),this.result.hidden=!1,this.experiments.hidden=this.answers.hidden=!0,this.reveal(),g?.focus({preventScroll:!0})}async tellMistakes(e){let{task:t}=this;e.textContent="Judging the moves ...";try{let n=await this.judge(this.record()),{actions:s}=this.world,o=({step:c,kind:h,meaning:d,cost:f})=>ze("tr",{},ze("td",{textContent:`${c+1}. ${t.actions[s[c]]}`}),ze("td",{},ze("b",{textContent:h}),`: ${d}`),ze("td",{textContent:cl(-f)}));e.replaceChildren(ze("h2",{textContent:n.length?"Mistakes, and what each cost":"No mistake: the ideal could do no better"}),ze("table",{},...n.map(o)))}catch(n){let s=n.name==="TimeoutError"?"it takes too long here":n.message;e.textContent=`The moves are not judged: ${s}.`}}reveal(){let{instance:e}=this.world,t=[...e.joined.map(o=>[o,"glued"]),...e.tied.map(o=>[o,"band"])],n=Object.entries(e.marks).filter(([o])=>this.scene.find(o)),s=n.map(([o,c])=>({thing:o,above:1,node:ze("span",{className:"mark",textContent:c})}));this.labels=[...this.labels.filter(({thing:o})=>!n.some(([c])=>c===o)),...s],this.marks.replaceChildren(...this.labels.map(({node:o})=>o)),this.draw();for(let[o,c]of t){let[h,d]=o.map(p=>this.scene.locate(p)),f=ze("span",{className:"mark",textContent:c});Object.assign(f.style,{left:`${50*(h[0]+d[0])}%`,top:`${50*(h[1]+d[1])}%`}),this.marks.append(f)}}};var ul="physexp",lb=400,cb=10,hb=async i=>{if(i[0]!==31)return i;let e=new Blob([i]).stream().pipeThrough(new DecompressionStream("gzip"));return new Uint8Array(await new Response(e).arrayBuffer())},eh=async i=>{let e=await fetch(i);if(!e.ok)throw new Error(`${i}: ${e.status} ${e.statusText}`);return e},th=i=>document.getElementById(i)?.textContent;async function ub(i=th("program")){let e=i?Uint8Array.from(atob(i),t=>t.charCodeAt(0)):new Uint8Array(await(await eh("mujoco.wasm.gz")).arrayBuffer());return Hh({wasmBinary:await hb(e)})}var db=async()=>JSON.parse(th("tasks")??await(await eh("tasks.json")).text()),fb=async i=>JSON.parse(th(i)??await(await eh(`${i}.json`)).text()),dl=i=>document.querySelector(`meta[name=${i}]`)?.content,Jd=(i,e,t)=>fetch(i,{method:"POST",body:JSON.stringify(e),...t});async function pb(i){let e={signal:AbortSignal.timeout(1e3*cb)},t=await Jd(dl("mistakes"),{player:ki.player(),...i},e);if(!t.ok)throw new Error(await t.text());return t.json()}var ki={all:()=>JSON.parse(localStorage.getItem(ul)??"[]"),add(i){let e={player:ki.player(),...i};localStorage.setItem(ul,JSON.stringify([...ki.all(),e])),dl("records")&&Jd(dl("records"),e)},player(){let e=new URLSearchParams(location.search).get("player")??localStorage.getItem(`${ul}-player`)??`person-${crypto.getRandomValues(new Uint32Array(1))[0].toString(36)}`;return localStorage.setItem(`${ul}-player`,e),e},save(){let i=ki.all().map(t=>`${JSON.stringify(t)}
`),e=URL.createObjectURL(new Blob(i,{type:"application/jsonl"}));ze("a",{href:e,download:"records.jsonl"}).click(),URL.revokeObjectURL(e)}},Qc=class{constructor(e,t){Object.assign(this,{mujoco:e,known:t,root:document.querySelector("main")}),this.bar=document.querySelector("nav")}async open(e,t,n=null){let s=this.known.map(p=>p.name);if(!s.includes(e))throw new Error(`it has no task ${e}; choose from ${s.join(", ")}`);this.player?.close();let o=await fb(this.known[s.indexOf(e)].file),c=()=>this.begin((this.instance+1)%o.instances.length),h=p=>{this.player.isReplay||ki.add(p),this.navigate()},d=dl("mistakes")?pb:null;this.player=new hl(this.root,this.mujoco,o,{onEnd:h,next:c,judge:d});let f=ki.all().filter(p=>p.task===o.name).length;this.begin(t===void 0?f%o.instances.length:this.instanceOf(o,t),!!n);for(let p of n??[])await new Promise(_=>setTimeout(_,lb)),await this.player.act(p)}instanceOf(e,t){let n=e.instances.map(s=>s.episode);if(!n.includes(t))throw new Error(`it has no episode ${t} of ${e.name}; choose from ${n.join(", ")}`);return n.indexOf(t)}begin(e,t=!1){this.instance=e,this.player.begin(e,t),this.navigate()}get link(){let{task:e,episode:t,actions:n}=this.player.record(),s=new URLSearchParams({task:e,episode:t,...n.length?{actions:n.join(",")}:{}});return`${location.href.split(/[?#]/)[0]}?${s}`.replaceAll("%2C",",").replaceAll("%2F","/")}navigate(){let{task:e}=this.player,t=this.known.map(({name:o,question:c})=>ze("option",{value:o,textContent:`${o}: ${c}`})),n=ze("select",{onchange:()=>this.open(n.value),title:"task"},...t);n.value=e.name;let s=ki.all().length;this.bar.replaceChildren(n,ze("span",{textContent:`instance ${this.instance+1} of ${e.instances.length}`}),ze("a",{href:this.link,textContent:this.player.isOver?"link to this replay":"link to this instance"}),ze("button",{textContent:`save ${s} record${s===1?"":"s"}`,disabled:!s,onclick:ki.save}))}};async function mb(){let i=document.querySelector("main");try{let[e,t]=await Promise.all([ub(),db()]),n=new URLSearchParams(location.search),s=n.get("actions")?.split(",").map(Number),o=n.has("episode")?Number(n.get("episode")):void 0;globalThis.physexp=new Qc(e,t),document.body.dataset.state="playing",await globalThis.physexp.open(n.get("task")??t[0].name,o,s),document.body.dataset.state="ready"}catch(e){throw i.textContent=`This page cannot be shown: ${e.message}`,document.body.dataset.state="failed",e}}globalThis.document?.querySelector("main")&&mb();export{hl as Player,Ws as World,ze as element,Hs as judge,ub as start,fb as taskOf};
